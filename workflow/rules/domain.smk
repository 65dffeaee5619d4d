# =================================================================================================
# Section 4: where hoppers are stable, Figures 4.4 and 4.5
# =================================================================================================

FIGURES += ["fig_4_4", "fig_4_4_30", "fig_4_5", "fig_4_5_map", "fig_domain_angle"]

MAP = config["stability_map"]
CASES = [
    f"{geometry}_{angle}" for angle in MAP["half_angles_deg"] for geometry in ["wedge", "cone"]
]


rule compute_friction_curve:
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


rule compute_map_chunk:
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
        **asks("compute_map_chunk", map_points(MAP["chunks"])),
    params:
        geometry="{geometry}",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=MAP["delta_deg"],
        phi_deg=MAP["phi_deg"],
        chunk=lambda wildcards: int(wildcards.chunk),
        chunks=MAP["chunks"],
    script:
        f"{SCRIPTS}/compute_map_chunk.py"


rule merge_map:
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
        **asks("merge_map", map_points()),
    params:
        geometry="{geometry}",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=MAP["delta_deg"],
        phi_deg=MAP["phi_deg"],
    script:
        f"{SCRIPTS}/merge_map.py"


rule compute_borders:
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
        check=config["borders"]["check"],
    script:
        f"{SCRIPTS}/compute_borders.py"


rule compute_paper_border:
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
    script:
        f"{SCRIPTS}/compute_paper_border.py"


rule compute_domain_angle:
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
    script:
        f"{SCRIPTS}/compute_domain_angle.py"


rule plot_fig_4_4:
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
                f"4.4, {curve('half_angle_deg')(wildcards):g}°",
                "max Re λ over wall friction",
                "wedge, cone",
                "both",
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
    script:
        f"{SCRIPTS}/plot_fig_4_4.py"


rule plot_fig_4_5:
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
    script:
        f"{SCRIPTS}/plot_fig_4_5.py"


rule plot_fig_4_5_map:
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
        **asks("plot_fig_4_5_map", map_points()),
    params:
        panels=[f"{case.replace('_', ', half angle ')}°" for case in CASES],
        color_range=config["fig_4_5_map"]["color_range"],
    script:
        f"{SCRIPTS}/plot_fig_4_5_map.py"


rule plot_fig_domain_angle:
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
    script:
        f"{SCRIPTS}/plot_fig_domain_angle.py"
