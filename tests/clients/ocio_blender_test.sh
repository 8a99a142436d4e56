# SPDX-License-Identifier: Apache-2.0
# Blender's compositor, Convert Colorspace node, without a display. Not in the list of packages that tests install.
. "${0%/*}/ocio_setup.sh"
command -v blender >/dev/null || skip "needs Blender"

cat >convert.py <<'END'
import sys

import bpy

photo, out, space, working_space, target_space = sys.argv[sys.argv.index("--") + 1 :]
scene = bpy.context.scene
scene.use_nodes = True
nodes, links = scene.node_tree.nodes, scene.node_tree.links
nodes.clear()
source = nodes.new("CompositorNodeImage")
source.image = bpy.data.images.load(photo)
source.image.colorspace_settings.name = space
convert = nodes.new("CompositorNodeConvertColorSpace")
convert.from_color_space = working_space  # what Blender has made of the image
convert.to_color_space = target_space
target = nodes.new("CompositorNodeComposite")
links.new(source.outputs[0], convert.inputs[0])
links.new(convert.outputs[0], target.inputs[0])
scene.render.resolution_x, scene.render.resolution_y = source.image.size
scene.render.resolution_percentage = 100
settings = scene.render.image_settings
settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
END
convert() {
    with "$scratch/reference.dng" timeout 120 blender -b --factory-startup --python-exit-code 1 -P convert.py -- "$@" \
        >blender.log 2>&1 || { cat blender.log; return 1; }
}
unprocessed() { convert "$scratch/photo.jpg" "$scratch/blender.exr" sRGB "Linear sRGB" "$camera" && near blender.exr raw.exr 1e-3; }
processed() { convert "$scratch/raw.exr" "$scratch/blender_back.exr" "Linear sRGB" "Linear sRGB" "$process" && near blender_back.exr back.tif 1e-3; }
"$tool" raw.exr --srisp-develop lin_rec709 -o:datatype=float developed.exr
developed() { convert "$scratch/photo.jpg" "$scratch/plate.exr" "srisp photo" "Linear sRGB" "Linear sRGB" && near plate.exr developed.exr 2e-3; }
converted() { convert "$scratch/photo.jpg" "$scratch/plate.exr" sRGB "Linear sRGB" "srisp scene linear" && near plate.exr developed.exr 2e-3; }
looks() { convert "$scratch/developed.exr" "$scratch/look.exr" "Linear sRGB" "Linear sRGB" "srisp photo" && near look.exr back.tif 0.02; }
check "Blender reads a photo as a developed plate" developed
check "or converts it to one" converted
check "Blender gives a plate the photo's look" looks
check "Blender unprocesses a photo to the library's pixels" unprocessed
check "Blender processes our EXR to the library's pixels" processed

# Blender's own config, extended.
own=$(find /usr/share/blender -path '*colormanagement/config.ocio' | head -n 1)
[ -n "$own" ] || skip "needs Blender's own config.ocio"
cp -r "${own%/*}" own
extended() {
    $bake --fragment own/config.ocio || return 1
    [ "$(diff "$own" own/config.ocio | grep -c '^<')" -eq 0 ] || { echo "lines are gone"; return 1; }
    OCIO=$scratch/own/config.ocio convert "$scratch/photo.jpg" "$scratch/own.exr" sRGB Linear "$camera" && near own.exr raw.exr 1e-3
}
check "Blender's own config, extended by --fragment, does the same" extended
finish
