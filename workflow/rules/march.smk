# =================================================================================================
# Beyond the paper: the stress marched down from the top, until it is radial, or breaks down
# =================================================================================================


rule compute_march_breakdown:
    """Marches: a march of the stress to its breakdown, entries of `march_breakdown`."""
    input:
        files=files_of_tops("march_breakdown"),
        code=code_of("compute_march_breakdown"),
    output:
        artifact="results/march_breakdown/{figure}.nc",
        provenance="results/march_breakdown/{figure}.provenance.json",
    log:
        "logs/compute_march_breakdown/{figure}.log",
    benchmark:
        "logs/compute_march_breakdown/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_breakdown"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hopper=march("march_breakdown", "hopper"),
        top=march("march_breakdown", "top"),
        depth=march("march_breakdown", "depth"),
        cells=march("march_breakdown", "cells"),
    message:
        "compute_march_breakdown/{wildcards.figure}: Marches: a march of the stress to its breakdown"
    script:
        f"{SCRIPTS}/compute_march_breakdown.py"


rule plot_fig_march_breakdown:
    """Marches: characteristics and psi up to the first crossing."""
    input:
        artifact="results/march_breakdown/{figure}.nc",
        code=code_of("plot_fig_march_breakdown"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_march_breakdown.rst",
            category="5 Marches down the hopper",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "characteristics and psi up to the first crossing",
                geometries("march_breakdown")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_march_breakdown/{figure}.log",
    benchmark:
        "logs/plot_fig_march_breakdown/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_breakdown"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_march_breakdown/{wildcards.figure}: figure of marches"
    script:
        f"{SCRIPTS}/plot_fig_march_breakdown.py"


rule compute_march_decay:
    """Marches: marches of bumps of several amplitudes, entries of `march_decay`."""
    input:
        code=code_of("compute_march_decay"),
    output:
        artifact="results/march_decay/{figure}.nc",
        provenance="results/march_decay/{figure}.provenance.json",
    log:
        "logs/compute_march_decay/{figure}.log",
    benchmark:
        "logs/compute_march_decay/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_decay"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hoppers=march("march_decay", "hoppers"),
        top=march("march_decay", "top"),
        eps=march("march_decay", "eps"),
        depth=march("march_decay", "depth"),
        points=march("march_decay", "points"),
        linear_eps=march("march_decay", "linear_eps"),
        cells=march("march_decay", "cells"),
    message:
        "compute_march_decay/{wildcards.figure}: Marches: marches of bumps of several amplitudes"
    script:
        f"{SCRIPTS}/compute_march_decay.py"


rule plot_fig_march_decay:
    """Marches: return to the radial field against the linear prediction."""
    input:
        artifact="results/march_decay/{figure}.nc",
        code=code_of("plot_fig_march_decay"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_march_decay.rst",
            category="5 Marches down the hopper",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "return to the radial field against the linear prediction",
                geometries("march_decay")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_march_decay/{figure}.log",
    benchmark:
        "logs/plot_fig_march_decay/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_decay"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_march_decay/{wildcards.figure}: figure of marches"
    script:
        f"{SCRIPTS}/plot_fig_march_decay.py"


rule compute_march_amplitude:
    """Marches: first crossings over the amplitude, entries of `march_amplitude`."""
    input:
        code=code_of("compute_march_amplitude"),
    output:
        artifact="results/march_amplitude/{figure}.nc",
        provenance="results/march_amplitude/{figure}.provenance.json",
    log:
        "logs/compute_march_amplitude/{figure}.log",
    benchmark:
        "logs/compute_march_amplitude/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_amplitude"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hoppers=march("march_amplitude", "hoppers"),
        top=march("march_amplitude", "top"),
        eps=march("march_amplitude", "eps"),
        estimates=march("march_amplitude", "estimates"),
        depth=march("march_amplitude", "depth"),
        cells=march("march_amplitude", "cells"),
        tolerance=march("march_amplitude", "tolerance"),
    message:
        "compute_march_amplitude/{wildcards.figure}: Marches: first crossings over the amplitude"
    script:
        f"{SCRIPTS}/compute_march_amplitude.py"


rule plot_fig_march_breakdown_amplitude:
    """Marches: depth of breakdown over amplitude."""
    input:
        artifact="results/march_amplitude/{figure}.nc",
        code=code_of("plot_fig_march_breakdown_amplitude"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_march_breakdown_amplitude.rst",
            category="5 Marches down the hopper",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "depth of breakdown over amplitude",
                geometries("march_amplitude")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_march_breakdown_amplitude/{figure}.log",
    benchmark:
        "logs/plot_fig_march_breakdown_amplitude/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_amplitude"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        depth=march("march_amplitude", "depth"),
    message:
        "plot_fig_march_breakdown_amplitude/{wildcards.figure}: figure of marches"
    script:
        f"{SCRIPTS}/plot_fig_march_breakdown_amplitude.py"


rule compute_march_depth:
    """Marches: tops marched down hoppers, entries of `march_depth`."""
    input:
        files=files_of_tops("march_depth"),
        code=code_of("compute_march_depth"),
    output:
        artifact="results/march_depth/{figure}.nc",
        provenance="results/march_depth/{figure}.provenance.json",
    log:
        "logs/compute_march_depth/{figure}.log",
    benchmark:
        "logs/compute_march_depth/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_depth"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    params:
        hoppers=march("march_depth", "hoppers"),
        tops=march("march_depth", "tops"),
        depth=march("march_depth", "depth"),
        cells=march("march_depth", "cells"),
        tolerance=march("march_depth", "tolerance"),
    message:
        "compute_march_depth/{wildcards.figure}: Marches: tops marched down hoppers"
    script:
        f"{SCRIPTS}/compute_march_depth.py"


rule plot_fig_march_depth:
    """Marches: how far down until the stress is radial."""
    input:
        artifact="results/march_depth/{figure}.nc",
        code=code_of("plot_fig_march_depth"),
    output:
        png=report(
            "figures/{figure}.png",
            caption="../report/fig_march_depth.rst",
            category="5 Marches down the hopper",
            labels=lambda wildcards: labels(
                entries.number_of(wildcards.figure),
                "how far down until the stress is radial",
                geometries("march_depth")(wildcards),
            ),
        ),
        pdf="figures/{figure}.pdf",
    log:
        "logs/plot_fig_march_depth/{figure}.log",
    benchmark:
        "logs/plot_fig_march_depth/{figure}.benchmark.tsv"
    wildcard_constraints:
        figure=targets.words(config["march_depth"]),
    conda:
        "../../envs/hopper.yaml"
    threads: 1
    message:
        "plot_fig_march_depth/{wildcards.figure}: figure of marches"
    script:
        f"{SCRIPTS}/plot_fig_march_depth.py"
