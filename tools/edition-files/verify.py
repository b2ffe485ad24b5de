#!/usr/bin/env python3
"""Checks this edition, and scores images by it; needs numpy and OpenImageIO alone (Debian: python3-numpy python3-openimageio).
  verify.py                       every file's checksum, every truth
  verify.py score SCENE IMAGE …   images of float visibility, as frame-59.exr; other names are of the scored frame"""
import hashlib, json, math, pathlib, re, sys
import numpy as np, OpenImageIO as oiio
root = pathlib.Path(__file__).resolve().parent

def read(file):
    opened = oiio.ImageInput.open(str(file))
    if opened is None: sys.exit(f"verify: cannot read {file}: {oiio.geterror()}")
    spec = opened.spec()
    if str(spec.format) not in ("float", "half"): sys.exit(f"verify: {file} holds integers: write linear floats, as EXR")
    pixels = opened.read_image(oiio.FLOAT).reshape(spec.height, spec.width, spec.nchannels)
    return {name: pixels[:, :, i] for i, name in enumerate(spec.channelnames)}

def mean(numbers):  # one after the other from the top left, so that the sum is the same on every machine
    return float(np.cumsum(numbers, dtype=np.float64)[-1] / numbers.size) if numbers.size else None

def checksums():
    named = {line[66:]: line[:64] for line in (root / "SHA256SUMS").read_text().splitlines()}
    found = {str(f.relative_to(root)) for f in root.rglob("*") if f.is_file()} - {"SHA256SUMS"}
    changed = [f for f in found & set(named) if hashlib.sha256((root / f).read_bytes()).hexdigest() != named[f]]
    return [f"{f}: changed, missing or added" for f in sorted(changed + list(found ^ set(named)))]

def faults(file, size):
    truth, about = read(file), json.loads(file.with_suffix(".json").read_text())
    on, measured, hard = truth["scored"] == 1, about["measured"], about["truth"] == "hard"
    v, sigma = truth["V"][on], truth["sigma"][on]
    rules = {"another size than scene.json says": [*on.shape[::-1]] == size,
             "scored is not 0 or 1, or not as often as the JSON says": np.isin(truth["scored"], (0, 1)).all() and on.sum() == about["scored"],
             "something is scored that is no receiver": (truth["surface"][on] == 2).all(),
             "V is not in [0, 1], or a label not 0 or 1": (np.isin(v, (0, 1)) if hard else (v >= 0) & (v <= 1)).all(),
             "sigma is not in [0, 0.1], or not 0 of a label": ((sigma >= 0) & (sigma <= (0 if hard else 0.1))).all(),
             "the certificate's error exceeds its bound": measured.get("certificate_rms", 0) <= measured.get("certificate_most_rms", 1)}
    return [f"{file.relative_to(root)}: {what}" for what, good in rules.items() if not good]

def score(scene, file):
    named, v = re.fullmatch(r"frame-(\d+)", pathlib.Path(file).stem), read(file)
    frame = named[1] if named else json.loads((root / "scenes" / scene / "scene.json").read_text())["frames"][0]["index"]
    for truth in sorted((root / "scenes" / scene / "truth").glob(f"frame-{frame}-*.exr")):
        t = read(truth)
        on = t["scored"] == 1
        exact = t["V"][on]
        drawn = next(v[c] for c in ("V", "Y", "R", *v) if c in v)[on]
        e, lit, wrong = abs(drawn.astype(float) - exact), exact >= 0.5, (drawn >= 0.5) != (exact >= 0.5)
        squares = {"rmse": e * e, "penumbra_rmse": (e * e)[(exact > 0) & (exact < 1)]}
        figures = {name: math.sqrt(mean(s)) for name, s in squares.items() if s.size}
        figures |= {"mae": mean(e), "bad30": mean(e > 30 / 255), "bad8": mean(e > 8 / 255)}
        if "edge_distance" in t: figures |= {"mismatch": mean(wrong), "mismatch_unrounded": mean(e), "leak": mean(wrong[~lit]),
            "false_shadow": mean(wrong[lit]), "mismatch_off_edge": mean(wrong[t["edge_distance"][on] > 0.5])}
        for name in figures: print(file, frame, truth.stem.split("-", 2)[2], name, figures[name])

if len(sys.argv) > 1: sys.exit([score(sys.argv[2], f) for f in sys.argv[3:]] and 0 if sys.argv[1] == "score" and sys.argv[3:] else __doc__)
scenes = [(f.parent, json.loads(f.read_text())) for f in sorted(root.glob("scenes/*/scene.json"))]
bare = [f"{d.name}: no truth of frame {n['index']}" for d, s in scenes for n in s["frames"] if not [*d.glob(f"truth/frame-{n['index']}-*.exr")]]
wrong = checksums() + bare + [w for d, s in scenes for f in sorted(d.glob("truth/*.exr")) for w in faults(f, s["size"])]
sys.exit("\n".join(wrong) or print(f"{len(scenes)} scenes and their truths are as they were made"))
