# =================================================================================================
# Section 4: where hoppers are stable, Figures 4.4 and 4.5
# =================================================================================================

CASES = [
    f"{geometry}_{angle}" for angle in MAP["half_angles_deg"] for geometry in ["wedge", "cone"]
]


rule compute_friction_curve:
    """Section 4: max Re(lambda) over wall friction, entries of `friction_curves`."""
    input:
        code=code_of("compute_friction_curve"),
    output:
        artifact="results/friction/{figure}/{geometry}.nc",
        provenance="results/friction/{figure}/{geometry}.provenance.json",
    log:
        "logs/compute_friction_curve/{figure}_{geometry}.log",
    benchmark:
        "logs/compute_friction_curve/{figure}_{geometry}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["friction_curves"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        half_angle_deg=curve("half_angle_deg"),
        deltas_deg=curve("deltas_deg"),
        mu=curve("mu"),
        check=curve("check"),
    message:
        "compute_friction_curve/{wildcards.figure}/{wildcards.geometry}: Section 4: max Re(lambda) over wall friction"
    script:
        f"{SCRIPTS}/compute_friction_curve.py"


use rule compute_friction_curve as compute_second_row with:
    output:
        artifact="results/friction/{figure}/{geometry}_second.nc",
        provenance="results/friction/{figure}/{geometry}_second.provenance.json",
    log:
        "logs/compute_second_row/{figure}_{geometry}.log",
    benchmark:
        "logs/compute_second_row/{figure}_{geometry}.benchmark.tsv"
    params:
        geometry="{geometry}",
        half_angle_deg=curve("half_angle_deg"),
        deltas_deg=curve("deltas_deg"),
        mu=curve("second_row"),
        check=None,
    message:
        "compute_second_row/{wildcards.figure}/{wildcards.geometry}: Section 4: up to the limit of friction"


rule compute_map_chunk:
    """Section 4: some rows of a stability map."""
    input:
        code=code_of("compute_map_chunk"),
    output:
        artifact="results/map/{geometry}_{angle}/{chunk}.nc",
        provenance="results/map/{geometry}_{angle}/{chunk}.provenance.json",
    log:
        "logs/compute_map_chunk/{geometry}_{angle}_{chunk}.log",
    benchmark:
        "logs/compute_map_chunk/{geometry}_{angle}_{chunk}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    resources:
        **asks("compute_map_chunk", map_points(MAP, MAP["chunks"])),
    params:
        geometry="{geometry}",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=MAP["delta_deg"],
        phi_deg=MAP["phi_deg"],
        chunk=lambda wildcards: int(wildcards.chunk),
        chunks=MAP["chunks"],
    message:
        "compute_map_chunk/{wildcards.geometry}/{wildcards.angle}/{wildcards.chunk}: Section 4: some rows of a stability map"
    script:
        f"{SCRIPTS}/compute_map_chunk.py"


rule merge_map:
    """Section 4: a stability map of its parts."""
    input:
        chunks=expand("results/map/{{geometry}}_{{angle}}/{chunk}.nc", chunk=range(MAP["chunks"])),
        code=code_of("merge_map"),
    output:
        artifact="results/map/{geometry}_{angle}.nc",
        provenance="results/map/{geometry}_{angle}.provenance.json",
    log:
        "logs/merge_map/{geometry}_{angle}.log",
    benchmark:
        "logs/merge_map/{geometry}_{angle}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    resources:
        **asks("merge_map", map_points(MAP)),
    params:
        geometry="{geometry}",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=MAP["delta_deg"],
        phi_deg=MAP["phi_deg"],
    message:
        "merge_map/{wildcards.geometry}/{wildcards.angle}: Section 4: a stability map of its parts"
    script:
        f"{SCRIPTS}/merge_map.py"


rule compute_borders:
    """Section 4: neutral curve and borders of the stable domain."""
    input:
        code=code_of("compute_borders"),
    output:
        artifact="results/borders/{geometry}_{angle}.nc",
        provenance="results/borders/{geometry}_{angle}.provenance.json",
    log:
        "logs/compute_borders/{geometry}_{angle}.log",
    benchmark:
        "logs/compute_borders/{geometry}_{angle}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="{geometry}",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        neutral_step_deg=config["borders"]["neutral_step_deg"],
        delta_deg=config["borders"]["delta_deg"],
        chord_deg=config["borders"]["chord_deg"],
        check=config["borders"]["check"],
    message:
        "compute_borders/{wildcards.geometry}/{wildcards.angle}: Section 4: neutral curve and borders of the stable domain"
    script:
        f"{SCRIPTS}/compute_borders.py"


rule compute_paper_border:
    """Section 4: the neutral curve of cones by the paper's algorithm."""
    input:
        border="results/borders/cone_{angle}.nc",
        code=code_of("compute_paper_border"),
    output:
        artifact="results/paper_border/cone_{angle}.nc",
        provenance="results/paper_border/cone_{angle}.provenance.json",
    log:
        "logs/compute_paper_border/cone_{angle}.log",
    benchmark:
        "logs/compute_paper_border/cone_{angle}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["paper_border"],
        half_angle_deg=lambda wildcards: float(wildcards.angle),
    message:
        "compute_paper_border/{wildcards.angle}: Section 4: the neutral curve of cones by the paper's algorithm"
    script:
        f"{SCRIPTS}/compute_paper_border.py"


rule compute_domain_angle:
    """Section 4: the stable domain of cones over the half angle."""
    input:
        code=code_of("compute_domain_angle"),
    output:
        artifact="results/domain_angle.nc",
        provenance="results/domain_angle.provenance.json",
    log:
        "logs/compute_domain_angle.log",
    benchmark:
        "logs/compute_domain_angle.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **config["domain_angle"],
    message:
        "compute_domain_angle: Section 4: the stable domain of cones over the half angle"
    script:
        f"{SCRIPTS}/compute_domain_angle.py"


rule plot_fig_4_4:
    """Figure 4.4, and each other entry of `friction_curves`."""
    input:
        unpack(second_row),
        wedge="results/friction/{figure}/wedge.nc",
        cone="results/friction/{figure}/cone.nc",
        code=code_of("plot_fig_4_4"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_4_4.rst",
            category="4 Stability",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                f"max Re λ over wall friction, half angle {curve('half_angle_deg')(wildcards):g}°",
                "wedge, cone",
                "paper and physical",
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_4_4/{figure}.log",
    benchmark:
        "logs/plot_fig_4_4/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["friction_curves"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        half_angle_deg=curve("half_angle_deg"),
    message:
        "plot_fig_4_4/{wildcards.figure}: figure over wall friction"
    script:
        f"{SCRIPTS}/plot_fig_4_4.py"


rule plot_fig_4_5:
    """Figure 4.5, the stable domain of cones."""
    input:
        borders=expand("results/borders/cone_{angle}.nc", angle=MAP["half_angles_deg"]),
        papers=expand("results/paper_border/cone_{angle}.nc", angle=MAP["half_angles_deg"]),
        code=code_of("plot_fig_4_5"),
    output:
        png=report(
            "figures/fig_4_5.png",
            caption="../report/fig_4_5.rst",
            category="4 Stability",
            labels=labels("4.5", "stable domain and its borders", "cone", "physical"),
        ),
        pdf="figures/fig_4_5.pdf",
    log:
        "logs/plot_fig_4_5.log",
    benchmark:
        "logs/plot_fig_4_5.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        half_angles_deg=MAP["half_angles_deg"],
        largest_phi_deg=MAP["phi_deg"]["stop"],
    message:
        "plot_fig_4_5: Figure 4.5, the stable domain of cones"
    script:
        f"{SCRIPTS}/plot_fig_4_5.py"


rule plot_fig_4_5_map:
    """Figure 4.5 as maps, wedge and cone."""
    input:
        maps=expand("results/map/{case}.nc", case=CASES),
        borders=expand("results/borders/{case}.nc", case=CASES),
        code=code_of("plot_fig_4_5_map"),
    output:
        png=report(
            "figures/fig_4_5_map.png",
            caption="../report/fig_4_5_map.rst",
            category="4 Stability",
            labels=labels("4.5 map", "max Re λ as maps", "wedge, cone", "physical"),
        ),
        pdf="figures/fig_4_5_map.pdf",
    log:
        "logs/plot_fig_4_5_map.log",
    benchmark:
        "logs/plot_fig_4_5_map.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    resources:
        **asks("plot_fig_4_5_map", map_points(MAP)),
    params:
        panels=[f"{case.replace('_', ', half angle ')}°" for case in CASES],
        color_range=config["fig_4_5_map"]["color_range"],
    message:
        "plot_fig_4_5_map: Figure 4.5 as maps, wedge and cone"
    script:
        f"{SCRIPTS}/plot_fig_4_5_map.py"


rule plot_fig_domain_angle:
    """The stable domain over the half angle."""
    input:
        artifact="results/domain_angle.nc",
        code=code_of("plot_fig_domain_angle"),
    output:
        png=report(
            "figures/fig_domain_angle.png",
            caption="../report/fig_domain_angle.rst",
            category="4 Stability",
            labels=labels(
                "4.5 half angle", "stable domain over the half angle", "cone", "physical"
            ),
        ),
        pdf="figures/fig_domain_angle.pdf",
    log:
        "logs/plot_fig_domain_angle.log",
    benchmark:
        "logs/plot_fig_domain_angle.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_domain_angle: The stable domain over the half angle"
    script:
        f"{SCRIPTS}/plot_fig_domain_angle.py"
