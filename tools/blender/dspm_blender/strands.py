"""Hair as curves: of curves objects, and of particle systems that are rendered as paths."""
import numpy as np

from .directive import Directive
from .mesh_arrays import column


def curves_strands(curves):
    """[(points, radii)] of Blender's hair curves."""
    points = column(curves.points, "position", 3, np.float32)
    radii = column(curves.points, "radius", 1, np.float32)
    starts = column(curves.curves, "first_point_index", 1, np.int32)
    lengths = column(curves.curves, "points_length", 1, np.int32)
    return [(points[start:start + length], radii[start:start + length]) for start, length in zip(starts, lengths) if length > 1]


def hair_systems(object):
    return [system for system in object.particle_systems
            if system.settings.type == "HAIR" and system.settings.render_type == "PATH"]


def particle_strands(object, system):
    """In the space of the object. As in Cycles, children take the place of their parents."""
    settings = system.settings
    parents, children = len(system.particles), len(system.child_particles)
    hairs = range(parents, parents + children) if settings.child_type != "NONE" and children else range(parents)
    steps = 2**settings.render_step + 1
    into = np.array(object.matrix_world.inverted_safe(), dtype=np.float64)
    radii = 0.5 * settings.radius_scale * np.linspace(settings.root_radius, settings.tip_radius, steps)
    for hair in hairs:
        points = np.array([system.co_hair(object, particle_no=hair, step=step) for step in range(steps)])
        yield points @ into[:3, :3].T + into[:3, 3], radii


def curve_line(points, radii):
    """Bezier segments through the points, with Catmull and Rom's tangents."""
    tangents = np.gradient(points, axis=0) / 3
    controls = np.empty((len(points) - 1, 3, 3))
    controls[:, 0], controls[:, 1], controls[:, 2] = points[:-1], points[:-1] + tangents[:-1], points[1:] - tangents[1:]
    return str(Directive("Shape", "curve").with_params({
        "point3 P": [*map(float, controls.ravel()), *map(float, points[-1])],
        "float width0": 2 * float(radii[0]), "float width1": 2 * float(radii[-1])}))
