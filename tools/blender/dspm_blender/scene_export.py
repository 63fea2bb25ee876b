"""A Blender scene as a .dsc file with its meshes and textures beside it."""
import os

from .camera import Camera
from .directive import Directive, quoted
from .hair import Hair
from .lights import KINDS, Light
from .materials import Materials
from .notes import Notes
from .objects import Objects, instance_key
from .shutter import lacks
from .strands import curves_strands, hair_systems, particle_strands
from .textures import Textures, file_name
from .variations import Variations
from .versions import VIEWS
from .volumes import VolumeObjects
from .world import World


class SceneExport:
    """Looks at one frame after the other, and then writes."""

    def __init__(self, path, variations, shutter):
        self.path, self.notes, self.variations = path, Notes(), Variations(variations)
        stem = os.path.splitext(path)[0]
        self.meshes = folder(f"{stem}.meshes")
        self.textures = Textures(f"{stem}.textures")
        self.materials = Materials(self.textures, self.notes)
        self.camera, self.world = Camera(self.notes, shutter.params()), World(self.textures.folder, self.notes)
        self.objects, self.lights, self.hair = Objects(self.meshes, self.materials), {}, {}
        self.volumes = VolumeObjects(path, self.materials, self.notes)
        self.medium_of_camera = None
        self.between = {}  # the instance's key -> [(time, matrix)]

    def see(self, frame, depsgraph):
        """Frames count from 1."""
        scene, layer = depsgraph.scene, depsgraph.view_layer_eval
        self.materials.override = layer.material_override
        self.camera.see(frame, scene.camera and scene.camera.evaluated_get(depsgraph), scene)
        self.world.see(frame, scene.world and scene.world.evaluated_get(depsgraph))
        self.materials.around = self.world.volume
        for instance in depsgraph.object_instances:
            object = instance.object
            for system in hair_systems(object) if instance.show_particles and not instance.is_instance else ():
                slots = object.material_slots
                material = slots[min(system.settings.material, len(slots)) - 1].material if slots else None
                self._see_hair(frame, instance, system.name, material, particle_strands(object, system))
            if not instance.show_self:
                continue
            self._note_lacks(instance, depsgraph.view_layer)
            if object.type == "LIGHT":
                light = Light(object.name, self.notes, self.variations.block(instance))
                self.lights.setdefault(instance_key(instance), light).see(frame, instance)
            elif object.type == "MESH":  # so do curves, surfaces, text and metaballs come, besides as themselves
                self.objects.see(frame, instance, self.variations.block(instance))
            elif object.type == "CURVES":
                self._see_hair(frame, instance, object.name, object.active_material, curves_strands(object.data))
            elif object.type == "VOLUME":
                self.volumes.see(frame, instance_key(instance), instance, self.variations.block(instance))
            elif object.type in {"POINTCLOUD", "GPENCIL", "GREASEPENCIL"}:
                self.notes.add(f'object "{object.name}": {object.type.lower()} is left out')
        self.variations.see(frame, self.materials)
        if frame == 1:
            self._see_media()

    def _see_media(self):
        """What the camera and the lamps stand in."""
        self.medium_of_camera = self.objects.medium_around(self.camera.place())
        for light in self.lights.values():
            if light.matrices and not light.is_far():
                light.medium = self.objects.medium_around(light.matrices[0][1].translation)

    def see_between(self, time, depsgraph):
        """Where things are at a time between frames."""
        scene = depsgraph.scene
        for lack in lacks(scene):
            self.notes.add(lack)
        if scene.camera:
            self.camera.see_between(time, scene.camera.evaluated_get(depsgraph), scene)
        for instance in depsgraph.object_instances:
            key = instance_key(instance)
            if key in self.lights:
                self.lights[key].see_between(time, instance)
            else:
                self.between.setdefault(key, []).append((time, instance.matrix_world.copy()))

    def _note_lacks(self, instance, layer):
        """What view layers ask of objects' collections, or the object itself."""
        object = (instance.parent if instance.is_instance else instance.object).original
        if object.is_holdout or object.holdout_get(view_layer=layer):
            self.notes.add(f'object "{object.name}": a holdout is an object as others are')
        linking = getattr(object, "light_linking", None)  # since Blender 4
        if linking and (linking.receiver_collection or linking.blocker_collection):
            self.notes.add(f'object "{object.name}": light linking is left out: it lights everything, and everything casts shadows')
        if object.indirect_only_get(view_layer=layer):
            self.notes.add(f'object "{object.name}": the camera sees it, though it is for indirect light only')

    def _see_hair(self, frame, instance, name, material, strands):
        key = (instance_key(instance), name)
        if key not in self.hair:
            self.hair[key] = Hair(f"{file_name(name)}.{len(self.hair)}", self.meshes, name,
                                  self.materials.shown(frame, material), self.variations.block(instance))
        self.hair[key].see(frame, instance.matrix_world.copy(), strands)

    def write(self, scene, settings, frames):
        """`frames` is their number."""
        world = self.world.lines()
        for (key, _), hair in self.hair.items():
            world += hair.lines(frames, self.between.get(key, ()))
        for light in self.lights.values():
            world += light.lines(frames, self.camera)
        outside = self.world.medium()
        world += [*self.objects.lines(frames, self.between, outside), *self.volumes.lines(frames, self.between, outside)]
        world += self.variations.lines(self.materials)
        around = [f"MediumInterface {quoted(self.medium_of_camera)}"] if self.medium_of_camera else []
        again = [f"MediumInterface {quoted(outside)}"] if around else []
        lines = [*head(scene, settings, frames, self.path), *self.world.medium_lines(), *around, *self.camera.lines(), "", "WorldBegin", *again,
                 *self.textures.lines, *self.materials.lines(), *world]
        with open(self.path, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


def folder(path):
    os.makedirs(path, exist_ok=True)
    return path


def head(scene, settings, frames, path):
    """What stands before the camera."""
    render = scene.render
    yield from seen_as(scene.view_settings)
    if frames > 1:
        yield f'Frames {frames} "float fps" {render.fps / render.fps_base:g}'
    yield str(settings.integrator_directive())
    film = {"integer xresolution": render.resolution_x * render.resolution_percentage // 100,
            "integer yresolution": render.resolution_y * render.resolution_percentage // 100,
            "string filename": os.path.splitext(os.path.basename(path))[0] + ".exr"}
    if render.film_transparent:
        film["bool transparent"] = True
    if render.use_border:
        film["integer pixelbounds"] = border(render, film["integer xresolution"], film["integer yresolution"])
    yield str(Directive("Film", "rgb").with_params(film))


def seen_as(view):
    """Images are linear; this is the view under which they look as in Blender."""
    name = VIEWS.get((view.view_transform, view.look))
    as_named = f"{view.view_transform}, {view.look}" if view.look != "None" else view.view_transform
    exposure = f" --exposure {view.exposure:g}" if view.exposure else ""
    gamma = f", and a gamma of {view.gamma:g}, which dspm has not" if view.gamma != 1 else ""
    yield f"# Blender's view: {as_named}" + (f"; dspm's: --view {name}{exposure}{gamma}" if name else ", which dspm has not")


def border(render, width, height):
    """In whole pixels, as Blender cuts them; dspm counts rows from above."""
    return [int(width * render.border_min_x), int(width * render.border_max_x),
            height - int(height * render.border_max_y), height - int(height * render.border_min_y)]
