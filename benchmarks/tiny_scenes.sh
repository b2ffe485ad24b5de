# shellcheck shell=sh
# Four scenes that are drawn and scored in a second each; to be sourced: `write_tiny_scenes FOLDER` writes point.toml, disk.toml,
# sky.toml and levels.toml (levels of detail).

write_tiny_scene() { # folder, name, light, more
    cat >"$1/$2.toml" <<SCENE
# A box over a slab.
title = "Tiny, $2"
size = [48, 48]
reference_samples = 64
camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }
light = $3
[timeline]
still = 3
moving = 1
[[object]]
mesh = { box = { size = [12, 0.2, 12] } }
place = [{ at = [0, -0.1, 0] }]
[[object]]
mesh = { box = { size = [1.6, 0.4, 1.2] } }
place = [{ at = [0.13, 1.2, 0.21] }]
$4
SCENE
}

write_tiny_scenes() {
    mkdir -p "$1"
    point='{ kind = "point", centre = [1.7, 6.1, -2.3] }'
    write_tiny_scene "$1" point "$point" ""
    write_tiny_scene "$1" disk '{ kind = "disk", centre = [1.7, 6.1, -2.3], u = [1.4, 0, 0.1], v = [-0.1, 0, 1.4] }' ""
    write_tiny_scene "$1" sky '{ kind = "environment", sky = { constant = 1 } }' ""
    write_tiny_scene "$1" levels "$point" '[[object]]
mesh = { sphere = { radius = 0.5 } }
lod = { triangles = [500, 80], until = [8] }
place = [{ at = [1.5, 0.45, 1.5] }, { at = [-1.5, 0.45, -1.5] }]
[lod]
frames = 5
band = 0.5
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 4, shift = [0, 0, -1] }]'
}
