# =================================================================================================
# Parameters of rules, looked up in the configuration by wildcards
# =================================================================================================


def hopper_of(wildcards):
    """Parameters of the hopper whose spectrum a figure shows."""
    case = config["spectra"][wildcards.figure]
    return {name: case[name] for name in ["delta_deg", "half_angle_deg", "mu"]}


def mesh(which):
    """Spectrum on one of the two meshes of a figure."""

    def path(wildcards):
        nodes = config["spectra"][wildcards.figure][which]
        return f"results/spectrum/{wildcards.figure}/{wildcards.geometry}_{nodes}.nc"

    return path


def spectrum_case(spectrum, geometry):
    """Hopper of one of the discrete spectra, by its name in the configuration."""
    case = config["spectra"][spectrum]
    return {
        "geometry": geometry,
        **{name: case[name] for name in ["delta_deg", "half_angle_deg", "mu"]},
    }


def transient(key):
    """A parameter of a transient figure."""
    return lambda wildcards: config["transient"][wildcards.figure][key]


def curve(key):
    """A parameter of a figure over wall friction."""
    return lambda wildcards: config["friction_curves"][wildcards.figure][key]
