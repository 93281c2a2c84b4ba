"""The panel in the sidebar, its settings and its two operators."""

import textwrap

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    PointerProperty,
    StringProperty,
)

from . import sheet

MISSING = (
    "Blender's Python does not find the package pysheetwright. Install it into the folder "
    "scripts/addons/modules of Blender: docs/blender.md says how."
)
# Later releases warn of a path beside the Blender file unless its property says that it takes one.
RELATIVE = (
    {"ANIMATABLE", "PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else {"ANIMATABLE"}
)


def _materials(_self, _context, typed):
    try:
        import pysheetwright as sw
    except ImportError:
        return []
    shown = [(it.name, f"{it.title}, {it.thickness_mm:g} mm") for it in sw.materials()]
    return [it for it in shown if typed.lower() in f"{it[0]} {it[1]}".lower()]


class SheetwrightSettings(bpy.types.PropertyGroup):
    """How meshes of a scene are unfolded."""

    material: StringProperty(
        name="Material", search=_materials, description="What it is made of, such as steel-1mm"
    )
    thickness: FloatProperty(
        name="Thickness (mm)", min=0.0, precision=2, description="0: that of the material"
    )
    seams: BoolProperty(
        name="Cut at seams", default=True, description="Edges that are marked as seams are cut"
    )
    facets: EnumProperty(
        name="Facets",
        items=[
            ("AUTO", "As it suits", "Folded where it would not bend as one surface"),
            (
                "FOLD",
                "Folded",
                "Between flat faces, as a paper model: nothing is stretched. Not for curved parts, "
                "whose triangles fold to slivers in many pieces",
            ),
            ("SMOOTH", "Smooth", "As one surface that bends"),
        ],
    )
    uv: BoolProperty(name="UV map", default=True, description="Also as a UV map of the mesh")
    folder: StringProperty(
        name="Folder", subtype="DIR_PATH", default="//sheetwright", options=RELATIVE
    )


class SheetwrightLine(bpy.types.PropertyGroup):
    """A line of an answer: a verdict or a finding."""

    text: StringProperty()
    icon: StringProperty(default="NONE")


class SheetwrightAnswer(bpy.types.PropertyGroup):
    """What was found of an object."""

    verdict: StringProperty()
    lines: CollectionProperty(type=SheetwrightLine)


ICONS = {"error": "ERROR", "warning": "ERROR", "note": "INFO"}


def answer(thing, made):
    """Keep the verdict and the findings of an object with it."""
    thing.sheetwright.verdict = ", ".join(part.verdict for part in made.parts)
    thing.sheetwright.lines.clear()

    def say(text, icon):
        line = thing.sheetwright.lines.add()
        line.text, line.icon = text, icon

    for part in made.parts:
        say(f"{part.name}: {part.verdict_text}", "CHECKMARK" if part.ok else "CANCEL")
        for finding in part.findings:
            say(finding.text, ICONS[finding.severity])


def settings_of(scene):
    """The settings of a scene as those of `pysheetwright.make_mesh`, and whether it cuts seams."""
    given = scene.sheetwright
    return given.seams, {
        "material": given.material or None,
        # Blender keeps seven digits of it.
        "thickness": float(f"{given.thickness:.7g}") or None,
        "facets": {"FOLD": True, "SMOOTH": False}.get(given.facets),
    }


class _OfMesh:
    """What both operators do: make the parts of the active mesh, and keep the answer."""

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        try:
            import pysheetwright as sw
        except ImportError:
            self.report({"ERROR"}, MISSING)
            return {"CANCELLED"}
        thing, mode = context.object, context.object.mode
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            seams, settings = settings_of(context.scene)
            try:
                shape, made = sheet.made_of(context, thing, seams=seams, **settings)
            except sw.SheetwrightError:
                # Nothing is left of what it was before.
                thing.sheetwright.verdict = ""
                thing.sheetwright.lines.clear()
                sheet.forget(thing)
                raise
            answer(thing, made)
            self.go_on(context, thing, shape, made)
        except (sw.SheetwrightError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if mode != "OBJECT":
                bpy.ops.object.mode_set(mode=mode)
        return {"FINISHED"}


class SHEETWRIGHT_OT_unfold(_OfMesh, bpy.types.Operator):
    """Unfold the active mesh: its pattern beside it, its verdict below"""

    bl_idname = "sheetwright.unfold"
    bl_label = "Unfold"
    bl_options = {"REGISTER", "UNDO"}

    def go_on(self, context, thing, shape, made):
        sheet.lay_beside(context, thing, shape, made)
        lost = sheet.map_uv(thing, shape, made) if context.scene.sheetwright.uv else 0
        if lost is None:
            self.report({"INFO"}, "Modifiers change the mesh, so it has no UV map: apply them first.")
        elif lost:
            self.report({"INFO"}, f"{lost} corners have no place in the UV map: the pattern has.")
        self.report({"INFO"}, thing.sheetwright.verdict)


class SHEETWRIGHT_OT_write(_OfMesh, bpy.types.Operator):
    """Write the patterns and the report of the active mesh into the folder"""

    bl_idname = "sheetwright.write"
    bl_label = "Write files"
    # It keeps the answer, so the scene is another.
    bl_options = {"REGISTER", "UNDO"}

    formats: StringProperty(name="Formats", default="svg,pdf,dxf,report")

    def go_on(self, context, thing, shape, made):
        folder = context.scene.sheetwright.folder
        if folder.startswith("//") and not bpy.data.filepath:
            raise OSError("Save the Blender file first, or choose another folder: // is its own.")
        folder = bpy.path.abspath(folder)
        names = made.write(folder, [name.strip() for name in self.formats.split(",")])
        self.report({"INFO"}, f"{len(names)} files in {folder}: {', '.join(names)}")


class SHEETWRIGHT_PT_panel(bpy.types.Panel):
    """The panel in the sidebar"""

    bl_label = "Sheetwright"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Sheetwright"

    def draw(self, context):
        layout, given = self.layout, context.scene.sheetwright
        for name in ("material", "thickness", "seams", "facets", "uv"):
            layout.prop(given, name)
        layout.operator(SHEETWRIGHT_OT_unfold.bl_idname, icon="MOD_UVPROJECT")
        layout.prop(given, "folder")
        layout.operator(SHEETWRIGHT_OT_write.bl_idname, icon="EXPORT")
        thing = context.object
        for line in thing.sheetwright.lines if thing else ():
            # A letter is about seven pixels wide.
            wide = max(20, int(context.region.width / (7 * context.preferences.system.ui_scale)))
            box = layout.column(align=True)
            for n, text in enumerate(textwrap.wrap(line.text, wide - 6)):
                box.label(text=text, icon=line.icon if n == 0 else "BLANK1")


CLASSES = [
    SheetwrightSettings,
    SheetwrightLine,
    SheetwrightAnswer,
    SHEETWRIGHT_OT_unfold,
    SHEETWRIGHT_OT_write,
    SHEETWRIGHT_PT_panel,
]


def register():
    """Register the classes, and the properties of scenes and objects."""
    for it in CLASSES:
        bpy.utils.register_class(it)
    bpy.types.Scene.sheetwright = PointerProperty(type=SheetwrightSettings)
    bpy.types.Object.sheetwright = PointerProperty(type=SheetwrightAnswer)


def unregister():
    """Take them away again."""
    del bpy.types.Object.sheetwright
    del bpy.types.Scene.sheetwright
    for it in reversed(CLASSES):
        bpy.utils.unregister_class(it)
