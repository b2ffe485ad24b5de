#!/bin/sh
# Draws every row of every technique on four tiny scenes (point, disk, sky, levels of detail) through OSMesa and through EGL in
# software, and compares the images that were scored, bit for bit:
#   benchmarks/same_images.sh BUILD FOLDER [TECHNIQUES]
# A folder that holds some of the rows gets the others. TECHNIQUES is a glob over ids (default: all).
set -eu
build=$1 folder=$2 techniques=${3:-}

write_scene() { # name, light, more
    cat >"$folder/$1.toml" <<SCENE
# A box over a slab.
title = "Tiny, $1"
size = [48, 48]
reference_samples = 64
camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }
light = $2
[timeline]
still = 3
moving = 1
[[object]]
mesh = { box = { size = [12, 0.2, 12] } }
place = [{ at = [0, -0.1, 0] }]
[[object]]
mesh = { box = { size = [1.6, 0.4, 1.2] } }
place = [{ at = [0.13, 1.2, 0.21] }]
$3
SCENE
}

images() { # "scene variant images" of each record that has images
    sed -nE 's/^.*"scene":"([^"]*)".*"variant":"([^"]*)".*"images":"([^"]*)".*$/\1 \2 \3/p' "$1"
}

mkdir -p "$folder"
point='{ kind = "point", centre = [1.7, 6.1, -2.3] }'
write_scene point "$point" ""
write_scene disk '{ kind = "disk", centre = [1.7, 6.1, -2.3], u = [1.4, 0, 0.1], v = [-0.1, 0, 1.4] }' ""
write_scene sky '{ kind = "environment", sky = { constant = 1 } }' ""
write_scene levels "$point" '[[object]]
mesh = { sphere = { radius = 0.5 } }
lod = { triangles = [500, 80], until = [8] }
place = [{ at = [1.5, 0.45, 1.5] }, { at = [-1.5, 0.45, -1.5] }]
[lod]
frames = 5
band = 0.5
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 4, shift = [0, 0, -1] }]'

for platform in osmesa egl; do
    for scene in point disk sky levels; do
        LIBGL_ALWAYS_SOFTWARE=1 "$build/shadowbench" run --quiet --resume --gl "$platform" --cost none \
            --scene "$folder/$scene.toml" ${techniques:+--technique "$techniques"} --cache "$folder/cache" \
            --out "$folder/$platform/$scene" >"$folder/$platform-$scene.log" 2>&1 ||
            tail -n 3 "$folder/$platform-$scene.log" >&2 # cells with errors are found below: they have no images
    done
    for scene in point disk sky levels; do images "$folder/$platform/$scene/results.jsonl"; done >"$folder/$platform.images"
done
rows=$(wc -l <"$folder/osmesa.images")
[ "$rows" -gt 0 ] || { echo "nothing was drawn" >&2; exit 5; }
if diff "$folder/osmesa.images" "$folder/egl.images"; then
    echo "$rows images of $(cut -d' ' -f2 "$folder/osmesa.images" | sort -u | wc -l) rows, all the same to the bit"
else
    echo "images differ: < OSMesa, > EGL" >&2
    exit 4
fi
