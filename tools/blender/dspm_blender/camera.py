"""The scene's camera. Blender looks along -z, dspm along +z of camera space."""
import math

from mathutils import Matrix, Vector

from .blocks import near, pose
from .directive import Directive, over_frames

FLIP = Matrix.Scale(-1, 4, (0, 0, 1))


def unscaled(matrix):
    """Blender's cameras and lamps have no size, whatever their objects' scale is."""
    place, turn, _ = matrix.decompose()
    return Matrix.Translation(place) @ turn.to_matrix().to_4x4()


class Camera:
    def __init__(self, notes, shutter):
        """`shutter` are its parameters of that."""
        self.notes, self.shutter, self.matrices, self.states = notes, shutter, [], []
        self.matrices_between, self.states_between = [], []

    def see(self, frame, camera, scene):
        if camera is None:
            raise RuntimeError("the scene has no camera")
        self.matrices.append((frame, FLIP @ unscaled(camera.matrix_world).inverted()))
        self.states.append((frame, self._directive(camera, scene).with_params(self.shutter)))

    def see_between(self, time, camera, scene):
        self.matrices_between.append((time, FLIP @ unscaled(camera.matrix_world).inverted()))
        self.states_between.append((time, self._directive(camera, scene).with_params(self.shutter)))

    def place(self):
        """Where it is in the first frame."""
        return self.matrices[0][1].inverted().translation

    def lines(self):
        return [*pose(near(self.matrices, self.matrices_between)), over_frames(near(self.states, self.states_between), self.notes)]

    def shows(self, matrices):
        """Does the picture of any frame show a part of the unit square, or ball, that (frame, matrix) pairs place?"""
        camera, states = dict(self.matrices), dict(self.states)
        return any(overlaps([camera[frame] @ (matrix @ corner) for corner in CORNERS], states[frame])
                   for frame, matrix in matrices)

    def _directive(self, camera, scene):
        data = camera.data
        if data.type == "PANO":
            settings = data if hasattr(data, "panorama_type") else data.cycles  # of Cycles before Blender 5
            if settings.panorama_type != "EQUIRECTANGULAR":
                self.notes.add(f'camera "{camera.name}": a panorama of all directions stands in')
            return Directive("Camera", "spherical").with_params({"string mapping": "equirectangular"})
        corners = data.view_frame(scene=scene)  # includes shift and the picture's shape
        depth = -corners[0].z if data.type == "PERSP" else 1
        xs, ys = ([corner[axis] / depth for corner in corners] for axis in (0, 1))
        window = {"float screenwindow": [min(xs), max(xs), min(ys), max(ys)]}
        if data.type == "ORTHO":
            return Directive("Camera", "orthographic").with_params({**window, **self._lens(camera)})
        return Directive("Camera", "perspective").with_params({"float fov": 90, **window, **self._lens(camera)})

    @staticmethod
    def _lens(camera):
        """Blender's f-stop is that of the opening's height, dspm's radius that of its longer axis."""
        data, dof = camera.data, camera.data.dof
        if not dof.use_dof:
            return {}
        focal_length = data.lens / 1000 if data.type == "PERSP" else 1
        radius = focal_length / (2 * dof.aperture_fstop) * max(1, 1 / dof.aperture_ratio)
        lens = {"float lensradius": radius, "float focaldistance": focus(camera)}
        if dof.aperture_ratio != 1 or dof.id_data.animation_data:
            lens["float anamorphic"] = dof.aperture_ratio
        if dof.aperture_blades >= 3:
            lens |= {"integer blades": dof.aperture_blades, "float bladerotation": math.degrees(dof.aperture_rotation)}
        return lens


def focus(camera):
    """Along the camera's axis."""
    dof = camera.data.dof
    if dof.focus_object is None:
        return max(dof.focus_distance, 1e-5)
    target = dof.focus_object.matrix_world.translation
    return max(-(unscaled(camera.matrix_world).inverted() @ target).z, 1e-5)


CORNERS = [Vector((x, y, z)) for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)]


def overlaps(corners, camera):
    """Points in camera space, and the camera's directive."""
    window = camera.params.get("float screenwindow")
    if window is None:
        return True
    if camera.names[0] == "perspective":
        front = [corner for corner in corners if corner.z > 0]
        if len(front) not in {0, len(corners)}:
            return True
        corners = [corner / corner.z for corner in front]
    return bool(corners) and all(
        max(corner[axis] for corner in corners) >= window[2 * axis] and
        min(corner[axis] for corner in corners) <= window[2 * axis + 1] for axis in (0, 1))
