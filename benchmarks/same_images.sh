#!/bin/sh
# Draws every row of every technique on four tiny scenes (point, disk, sky, levels of detail) through OSMesa and through EGL in
# software, and compares the images that were scored, bit for bit:
#   benchmarks/same_images.sh BUILD FOLDER [TECHNIQUES]
# A folder that holds some of the rows gets the others. TECHNIQUES is a glob over ids (default: all).
set -eu
build=$1 folder=$2 techniques=${3:-}
# shellcheck source=benchmarks/tiny_scenes.sh
. "$(dirname "$0")/tiny_scenes.sh"

images() { # "scene variant images" of each record that has images
    sed -nE 's/^.*"scene":"([^"]*)".*"variant":"([^"]*)".*"images":"([^"]*)".*$/\1 \2 \3/p' "$1"
}

write_tiny_scenes "$folder"

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
