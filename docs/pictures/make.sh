#!/bin/sh
# Makes the pictures beside this file, in the gate profile: PCSS on overlapping-occluders, which the front page shows, a figure
# of the same (docs/figures.md), and what filters do where they are worse than the map alone (docs/findings.md). Those of
# engines need clients/*/setup.
set -eu
cd "$(dirname "$0")/../.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
./bench run --scene overlapping-occluders --technique pcss --cost none --images --quiet --out "$out"
for picture in visibility reference error; do
    cp "$out/images/overlapping-occluders/pcss/$picture.png" "docs/pictures/pcss-$picture.png"
done
./bench figure --scene overlapping-occluders --technique pcf --technique pcss --shaded --quiet --out docs/pictures/figure.svg
./bench run --scene light-behind-camera --scene tessellation --technique sm-uniform --technique pcf \
    --technique sm-history:filter=pcf --cost none --images --quiet --out "$out"
cp "$out/images/light-behind-camera/sm-uniform/error.png" docs/pictures/behind-uniform.png
cp "$out/images/light-behind-camera/pcf/error.png" docs/pictures/behind-pcf.png
cp "$out/images/tessellation/sm-history_filter=pcf/error.png" docs/pictures/tessellation-history.png
for client in threejs/external:threejs-pcf babylonjs/external:babylonjs-none blender/external:eevee-hard \
    playcanvas/external:playcanvas-pcf3 filament/external:filament-pcf openscenegraph/directional:osg-pssm \
    ogre/external:ogre-stencil godot/external:godot-pcf5 vtk/external:vtk-shadow-map; do
    row=${client#*:}
    list=${client%:*}
    name=${list%/*}
    [ "$name" != blender ] || name=eevee
    ./bench run --scene windmills --external "clients/$list.toml" --technique "external:$row" --cost none --images --quiet --out "$out"
    cp "$out/images/windmills/external_$row/visibility.png" "docs/pictures/engines-$name.png"
done
