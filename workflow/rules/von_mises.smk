# =================================================================================================
# The stability the paper leaves out: cones of von Mises material
# =================================================================================================


rule compute_von_mises_chunk:
    """Von Mises cones: some rows of a map of verdicts."""
    input:
        code=code_of("compute_von_mises_chunk"),
    output:
        artifact="results/von_mises/map/cone_{angle}/{chunk}.nc",
        provenance="results/von_mises/map/cone_{angle}/{chunk}.provenance.json",
    log:
        "logs/compute_von_mises_chunk/cone_{angle}_{chunk}.log",
    benchmark:
        "logs/compute_von_mises_chunk/cone_{angle}_{chunk}.benchmark.tsv"
    wildcard_constraints:
        chunk=targets.words(range(VON_MISES["map"]["chunks"])),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    resources:
        **asks("compute_von_mises_chunk", map_points(VON_MISES["map"], VON_MISES["map"]["chunks"])),
    params:
        geometry="cone",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=VON_MISES["map"]["delta_deg"],
        phi_deg=VON_MISES["map"]["phi_deg"],
        chunk=lambda wildcards: int(wildcards.chunk),
        chunks=VON_MISES["map"]["chunks"],
    message:
        "compute_von_mises_chunk/{wildcards.angle}/{wildcards.chunk}: Von Mises cones: some rows of a map of verdicts"
    script:
        f"{SCRIPTS}/compute_von_mises_chunk.py"


rule merge_von_mises_map:
    """Von Mises cones: a map of verdicts of its parts."""
    input:
        chunks=expand(
            "results/von_mises/map/cone_{{angle}}/{chunk}.nc",
            chunk=range(VON_MISES["map"]["chunks"]),
        ),
        code=code_of("merge_von_mises_map"),
    output:
        artifact="results/von_mises/map/cone_{angle}.nc",
        provenance="results/von_mises/map/cone_{angle}.provenance.json",
    log:
        "logs/merge_von_mises_map/cone_{angle}.log",
    benchmark:
        "logs/merge_von_mises_map/cone_{angle}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="cone",
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        delta_deg=VON_MISES["map"]["delta_deg"],
        phi_deg=VON_MISES["map"]["phi_deg"],
    message:
        "merge_von_mises_map/{wildcards.angle}: Von Mises cones: a map of verdicts of its parts"
    script:
        f"{SCRIPTS}/merge_von_mises_map.py"


rule compute_von_mises_domain:
    """Von Mises cones: types, neutral curve and decay rates."""
    input:
        code=code_of("compute_von_mises_domain"),
    output:
        artifact="results/von_mises/domain/cone_{angle}.nc",
        provenance="results/von_mises/domain/cone_{angle}.provenance.json",
    log:
        "logs/compute_von_mises_domain/cone_{angle}.log",
    benchmark:
        "logs/compute_von_mises_domain/cone_{angle}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        **VON_MISES["domain"],
        half_angle_deg=lambda wildcards: float(wildcards.angle),
        least_delta_deg=VON_MISES["map"]["delta_deg"]["start"],
    message:
        "compute_von_mises_domain/{wildcards.angle}: Von Mises cones: types, neutral curve and decay rates"
    script:
        f"{SCRIPTS}/compute_von_mises_domain.py"


rule compute_von_mises_spectrum:
    """Von Mises cones: resolved modes and the law of high frequency."""
    input:
        code=code_of("compute_von_mises_spectrum"),
    output:
        artifact="results/von_mises/spectrum/{cone}.nc",
        provenance="results/von_mises/spectrum/{cone}.provenance.json",
    log:
        "logs/compute_von_mises_spectrum/{cone}.log",
    benchmark:
        "logs/compute_von_mises_spectrum/{cone}.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        geometry="cone",
        delta_deg=von_mises_cone("delta_deg"),
        half_angle_deg=von_mises_cone("half_angle_deg"),
        mu=von_mises_cone("mu"),
        half_nodes=config["fig_vm_spectra"]["half_nodes"],
    message:
        "compute_von_mises_spectrum/{wildcards.cone}: Von Mises cones: resolved modes and the law of high frequency"
    script:
        f"{SCRIPTS}/compute_von_mises_spectrum.py"


rule plot_fig_vm_types:
    """Type and verdict of von Mises cones."""
    input:
        maps=expand("results/von_mises/map/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]),
        domains=expand(
            "results/von_mises/domain/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]
        ),
        code=code_of("plot_fig_vm_types"),
    output:
        png=report(
            "figures/fig_vm_types.png",
            caption="../report/fig_vm_types.rst",
            category="von Mises",
            labels=labels("von Mises types", "type, verdict and neutral curve", "cone"),
        ),
        pdf="figures/fig_vm_types.pdf",
    log:
        "logs/plot_fig_vm_types.log",
    benchmark:
        "logs/plot_fig_vm_types.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        half_angles_deg=VON_MISES["half_angles_deg"],
    message:
        "plot_fig_vm_types: Type and verdict of von Mises cones"
    script:
        f"{SCRIPTS}/plot_fig_vm_types.py"


rule plot_fig_vm_spectra:
    """Spectra of von Mises cones, with the laws of high frequency."""
    input:
        spectra=expand(
            "results/von_mises/spectrum/{cone}.nc", cone=config["fig_vm_spectra"]["hoppers"]
        ),
        code=code_of("plot_fig_vm_spectra"),
    output:
        png=report(
            "figures/fig_vm_spectra.png",
            caption="../report/fig_vm_spectra.rst",
            category="von Mises",
            labels=labels("von Mises spectra", "modes and laws of high frequency", "cone"),
        ),
        pdf="figures/fig_vm_spectra.pdf",
    log:
        "logs/plot_fig_vm_spectra.log",
    benchmark:
        "logs/plot_fig_vm_spectra.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_vm_spectra: Spectra of von Mises cones, with the laws of high frequency"
    script:
        f"{SCRIPTS}/plot_fig_vm_spectra.py"


rule plot_fig_vm_decay:
    """Decay of end effects in elliptic von Mises cones."""
    input:
        domains=expand(
            "results/von_mises/domain/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]
        ),
        code=code_of("plot_fig_vm_decay"),
    output:
        png=report(
            "figures/fig_vm_decay.png",
            caption="../report/fig_vm_decay.rst",
            category="von Mises",
            labels=labels("von Mises decay", "decay of end effects, down and up", "cone"),
        ),
        pdf="figures/fig_vm_decay.pdf",
    log:
        "logs/plot_fig_vm_decay.log",
    benchmark:
        "logs/plot_fig_vm_decay.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        half_angles_deg=VON_MISES["half_angles_deg"],
    message:
        "plot_fig_vm_decay: Decay of end effects in elliptic von Mises cones"
    script:
        f"{SCRIPTS}/plot_fig_vm_decay.py"


rule plot_fig_models_stability:
    """What both models say of the same cones."""
    input:
        borders=expand("results/borders/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]),
        domains=expand(
            "results/von_mises/domain/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]
        ),
        maps=expand("results/von_mises/map/cone_{angle}.nc", angle=VON_MISES["half_angles_deg"]),
        code=code_of("plot_fig_models_stability"),
    output:
        png=report(
            "figures/fig_models_stability.png",
            caption="../report/fig_models_stability.rst",
            category="von Mises",
            labels=labels("Both models", "stability by both models", "cone"),
        ),
        pdf="figures/fig_models_stability.pdf",
    log:
        "logs/plot_fig_models_stability.log",
    benchmark:
        "logs/plot_fig_models_stability.benchmark.tsv"
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        half_angles_deg=VON_MISES["half_angles_deg"],
    message:
        "plot_fig_models_stability: What both models say of the same cones"
    script:
        f"{SCRIPTS}/plot_fig_models_stability.py"
