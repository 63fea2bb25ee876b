"""Pictures of floating-point numbers."""
import numpy as np


def write_pfm(path, colours):
    """Of colours, or numbers if there is no last axis; row 0 is the lowest, as PFM has it."""
    height, width = colours.shape[:2]
    with open(path, "wb") as file:
        file.write(f"{'PF' if colours.ndim == 3 else 'Pf'}\n{width} {height}\n-1\n".encode())
        file.write(np.ascontiguousarray(colours, dtype="<f4"))
