#!/bin/sh
# Makes the pictures beside this file, which the front page shows: PCSS on overlapping-occluders in the gate profile.
set -eu
cd "$(dirname "$0")/../.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
./bench run --scene overlapping-occluders --technique pcss --cost none --images --quiet --out "$out"
for picture in visibility reference error; do
    cp "$out/images/overlapping-occluders/pcss/$picture.png" "docs/pictures/pcss-$picture.png"
done
