"""From a dataset of CF variables back to names and complex numbers."""

import numpy as np
import xarray as xr


def decoded(stored: xr.Dataset) -> xr.Dataset:
    """Return a dataset with the names of its flags, and its complex numbers in one piece."""
    result = stored.copy()
    for name in list(stored.variables):
        variable = stored[name]
        if "flag_meanings" in variable.attrs:
            # References to a few words: as large as the numbers of a map beside them.
            words = np.array(variable.attrs["flag_meanings"].split(), dtype=object)
            attributes = {key: variable.attrs[key] for key in ("long_name",)}
            result[name] = (variable.dims, words[variable.to_numpy()], attributes)
        elif str(name).endswith("_real") and (base := str(name)[:-5]) + "_imag" in stored:
            parts = variable, stored[f"{base}_imag"]
            long_name = variable.attrs["long_name"].removeprefix("real part of ")
            attributes = {**variable.attrs, "long_name": long_name}
            values = parts[0].to_numpy() + 1j * parts[1].to_numpy()
            result = result.drop_vars([f"{base}_real", f"{base}_imag"])
            result[base] = (variable.dims, values, attributes)
    return result
