# =================================================================================================
# Parameters of rules, looked up in the configuration by wildcards
# =================================================================================================

import math


def labels(figure, shows, geometry, formulation="—"):
    """Columns of a figure's row in the report; its section is the category."""
    return {"figure": figure, "shows": shows, "geometry": geometry, "formulation": formulation}


def radial(key):
    """A parameter of a figure of radial fields."""
    return lambda wildcards: config["radial"][wildcards.figure][key]


def hopper_of(spectrum):
    """Parameters of the hopper of one of the discrete spectra, by its name."""
    case = config["spectra"][spectrum]
    return {name: case[name] for name in ["delta_deg", "half_angle_deg", "mu"]}


def mesh(which):
    """Spectrum on one of the two meshes of a figure."""

    def path(wildcards):
        nodes = config["spectra"][wildcards.figure][which]
        return f"results/spectrum/{wildcards.figure}/{wildcards.geometry}_{nodes}.nc"

    return path


def spectrum_case(spectrum, geometry):
    """The same with its geometry."""
    return {"geometry": geometry, **hopper_of(spectrum)}


def transient(key):
    """A parameter of a transient figure."""
    return lambda wildcards: config["transient"][wildcards.figure][key]


def kept_in(wildcards):
    """The formulations of a transient figure."""
    return " and ".join(transient("kept_in")(wildcards))


def pseudospectrum(key):
    """A parameter of a figure of pseudospectra."""
    return lambda wildcards: config["pseudospectrum"][wildcards.figure][key]


def formulations(wildcards):
    """The formulations of a figure of pseudospectra, the paper's first."""
    chosen = pseudospectrum("formulations")(wildcards)
    return [each for each in FORMULATIONS if each in chosen]


def weighting(key):
    """Norm or weight of psi of one of them."""
    return lambda wildcards: pseudospectrum("formulations")(wildcards)[wildcards.formulation][key]


def curve(key):
    """A parameter of a figure over wall friction."""
    return lambda wildcards: config["friction_curves"][wildcards.figure][key]


def march(section, key):
    """A parameter of a figure of marches."""
    return lambda wildcards: config[section][wildcards.figure][key]


def files_of_tops(section):
    """The files that hold tops of a figure of marches."""
    return lambda wildcards: entries.files_of_tops(config[section][wildcards.figure])


def geometries(section):
    """The geometries of a figure of marches, for its row in the report."""

    def found(wildcards):
        entry = config[section][wildcards.figure]
        hoppers = entry["hoppers"] if "hoppers" in entry else [entry["hopper"]]
        return ", ".join(dict.fromkeys(hopper["geometry"] for hopper in hoppers))

    return found


def second_row(wildcards):
    """The artifacts of a figure's second row, if it has one."""
    if "second_row" not in config["friction_curves"][wildcards.figure]:
        return {}
    path = f"results/friction/{wildcards.figure}/{{}}_second.nc"
    return {f"{geometry}_second": path.format(geometry) for geometry in ("wedge", "cone")}


def own_hopper(wildcards):
    """One of the hoppers of `cases`, by its name."""
    return next(case for case in config["cases"] if case["name"] == wildcards.case)


def labels_of_case(wildcards):
    """Columns of a case's row in the report, which is written when its artifact is there."""
    case = own_hopper(wildcards)
    return {
        "case": case["name"],
        "verdict": cases.verdict(f"results/cases/{case['name']}.nc"),
        "hopper": case["geometry"],
        **own_hoppers.shown(case),
    }


def mesh_of(spectrum):
    """Nodes of both meshes and tolerance of the filter of one of the discrete spectra."""
    case = config["spectra"][spectrum]
    return {name: case[name] for name in ["nodes", "coarse_nodes", "tolerance"]}


def von_mises_cone(key):
    """A parameter of a cone of `fig_vm_spectra`."""
    return lambda wildcards: config["fig_vm_spectra"]["hoppers"][wildcards.cone][key]


def map_points(grid, chunks=None):
    """Points of a map, or of the largest of its chunks."""
    rows, columns = (grid[axis]["points"] for axis in ["delta_deg", "phi_deg"])
    return rows * columns if chunks is None else math.ceil(rows / chunks) * columns
