// Every mistake in a scene file gives one sentence that names file, line and key.
#include "base/error.h"
#include "scene/load/load.h"

#include <gtest/gtest.h>
#include <string>

namespace shadowbench {
namespace {

/// Lines 1–8 of a sound scene; each mistake below is in these or is added from line 9 on.
const std::string kCamera = "camera = { eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n";
const std::string kLight = "light = { kind = \"point\", centre = [1, 5, 2] }\n";
const std::string kObject = "[[object]]\nmesh = { box = { size = [2, 1, 2] } }\n";

/// What the loader says of the scene, where bounds can be put on the first metrics of a table.
std::string messageOf(const std::string& toml, Profile profile = Profile::Gate) {
    try {
        parseScene(toml, "scenes/x.toml", profile, {"mismatch", "mismatch_off_edge", "false_shadow", "leak"});
    } catch (const BadInput& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

struct Mistake {
    std::string name, toml, message; // the message's beginning
};

std::string with(const std::string& camera, const std::string& light, const std::string& object) {
    return "title = \"x\"\n" + camera + light + object; // camera on line 2, light on line 3, object from line 4
}

std::string withObject(const std::string& body) {
    return with(kCamera, kLight, "[[object]]\n" + body + "\n"); // the body begins on line 5
}

std::string withMatrix(const std::string& numbers) {
    return withObject("mesh = { box = { size = [2, 1, 2] } }\nplace = [{ matrix = [" + numbers + "] }]");
}

std::string withLight(const std::string& inside) { return with(kCamera, "light = { " + inside + " }\n", kObject); }

std::string withCamera(const std::string& inside) { return with("camera = { " + inside + " }\n", kLight, kObject); }

/// An `expect.fails` with one entry, on line 7.
std::string withExpectedFailure(const std::string& entry) {
    return with(kCamera, kLight, kObject + "[expect]\nfails = [{ " + entry + " }]\n");
}

std::string withTop(const std::string& line) {
    return line + "\n" + with(kCamera, kLight, kObject); // on line 1
}

const std::vector<Mistake>& mistakes() {
    static const std::vector<Mistake> all{
        {"EmptyFile", "", "scenes/x.toml:1: the file is empty"},
        {"OnlyAComment", "# nothing\n", "scenes/x.toml:1: the file is empty"},
        {"SyntaxError", "title = \"x\"\ncamera = {\n", "scenes/x.toml:2: not valid TOML"},
        {"KeyTwice", "title = \"x\"\ntitle = \"y\"\n", "scenes/x.toml:2: not valid TOML"},
        {"UnknownKey", withTop("ligth = 3"), "scenes/x.toml:1: ligth: unknown key (did you mean \"light\"?)"},
        {"UnknownKeyWithoutNeighbour", withTop("zebra = 3"), "scenes/x.toml:1: zebra: unknown key; known are title"},
        {"UnknownCameraKey", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fov = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.fov: unknown key (did you mean \"fovy\"?)"},
        {"UnknownToleranceMetric", with(kCamera, kLight, kObject + "[tolerance]\nmissmatch = 0.1\n"),
         "scenes/x.toml:7: tolerance.missmatch: unknown key (did you mean \"mismatch\"?)"},
        {"MissingTitle", kCamera + kLight + kObject, "scenes/x.toml:1: title: missing"},
        {"MissingCamera", "title = \"x\"\n" + kLight + kObject, "scenes/x.toml:1: camera: missing"},
        {"MissingFovy", withCamera("eye = [0, 2, 6], target = [0, 0, 0], near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.fovy: missing"},
        {"WrongType", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = \"wide\", near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.fovy: expected a number, got \"wide\""},
        {"TooFewNumbers", withCamera("eye = [0, 2], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.eye: expected 3 numbers, got a list of 2"},
        {"NotAVector", withLight("kind = \"rectangle\", centre = [0, 5, 0], u = \"a\", v = [0, 0, 1]"),
         "scenes/x.toml:3: light.u: expected 3 numbers, got \"a\""},
        {"WholeNumberThatADoubleRounds", withLight("kind = \"point\", centre = [0, 9007199254740993, 0]"),
         "scenes/x.toml:3: light.centre[2]: expected a number of at most 1e+12 in size, got 9007199254740993"},
        {"NotANumberInAVector", withLight("kind = \"point\", centre = [0, nan, 0]"),
         "scenes/x.toml:3: light.centre[2]: expected a finite number, got nan"},
        {"Infinity", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = inf"),
         "scenes/x.toml:2: camera.far: expected a finite number, got inf"},
        {"LightBeyondSinglePrecision", withLight("kind = \"point\", centre = [0, -1e308, 0]"),
         "scenes/x.toml:3: light.centre[2]: expected a number of at most 1e+12 in size, got -1e+308"},
        {"EyeBeyondSinglePrecision", withCamera("eye = [0, 2, 6e40], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.eye[3]: expected a number of at most 1e+12 in size, got 6e+40"},
        {"ObjectScaledBeyondTheLargestDistance",
         withObject("mesh = { box = { size = [1e9, 1, 1] } }\nplace = [{ scale = 1e9 }]"),
         "scenes/x.toml:4: object: an object reaches farther than 1e+12 m from the origin at frame 59; make it smaller"},
        {"FovyTooLarge", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 180, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.fovy: expected degrees from 1 to 170"},
        {"NearNotAboveZero", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0, far = 60"),
         "scenes/x.toml:2: camera.near: expected a number above 0, got 0"},
        {"FarNotBeyondNear", withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 9, far = 3"),
         "scenes/x.toml:2: camera.far: expected more than near"},
        {"EyeAtTarget", withCamera("eye = [0, 2, 6], target = [0, 2, 6], fovy = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.target: the camera looks at its own eye"},
        {"UpAlongTheView", withCamera("eye = [0, 6, 0], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera: up is zero or parallel to the line of sight"},
        {"PathGoesBack",
         withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = 3, eye = "
                    "[0, 2, 6] }, { frame = 3, eye = [0, 2, 7] }]"),
         "scenes/x.toml:2: camera.path[2].frame: frames must grow"},
        {"PathBeforeTheStillFrames",
         withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = -1, eye = "
                    "[0, 2, 6] }, { frame = 0, eye = [0, 2, 7] }]"),
         "scenes/x.toml:2: camera.path[1].frame: frames must grow, from 0 (the last still frame)"},
        {"ShiftAndEyeInAPath",
         withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = 3, eye = "
                    "[0, 2, 6], shift = [1, 0, 0] }]"),
         "scenes/x.toml:2: camera.path[1]: give either shift or eye and target"},
        {"ShiftInSomeKeysOfAPath",
         withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = 3, shift = "
                    "[0, 2, 6] }, { frame = 4, eye = [1, 0, 9] }]"),
         "scenes/x.toml:2: camera.path[2]: give shift (of eye and target) in every key or in none"},
        {"UnknownLightKind", withLight("kind = \"dsik\", centre = [0, 5, 0]"),
         "scenes/x.toml:3: light.kind: expected one of point, directional, rectangle, disk, line, environment, got \"dsik\" "
         "(did "
         "you mean \"disk\"?)"},
        {"KeyOfAnotherLightKind", withLight("kind = \"point\", centre = [0, 5, 0], u = [1, 0, 0]"),
         "scenes/x.toml:3: light.u: unknown key"},
        {"ZeroDirection", withLight("kind = \"directional\", direction = [0, 0, 0]"),
         "scenes/x.toml:3: light.direction: expected a vector other than zero"},
        {"LightOfNoWidth", withLight("kind = \"rectangle\", centre = [0, 5, 0], u = [0, 0, 0], v = [0, 0, 1]"),
         "scenes/x.toml:3: light.u: the light has no size"},
        {"LightOfNoArea", withLight("kind = \"rectangle\", centre = [0, 5, 0], u = [0, 0, 2], v = [0, 0, 1]"),
         "scenes/x.toml:3: light.v: is parallel to u"},
        {"SlantedDisk", withLight("kind = \"disk\", centre = [0, 5, 0], u = [1, 0, 1], v = [0, 0, 1]"),
         "scenes/x.toml:3: light.v: the diameters of a disk"},
        {"MatrixOfTwelveNumbers", withObject("mesh = { box = { size = [2, 1, 2] } }\nplace = [{ matrix = [1, 0, 0] }]"),
         "scenes/x.toml:6: object[1].place[1].matrix: expected 16 numbers, column by column, got 3"},
        {"MatrixByRows", withMatrix("1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"),
         "scenes/x.toml:6: object[1].place[1].matrix: expected numbers 4, 8 and 12 to be 0 and number 16 to be 1"},
        {"MatrixThatMirrors", withMatrix("-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"),
         "scenes/x.toml:6: object[1].place[1].matrix: is flat or mirrors the object"},
        {"MatrixThatShears", withMatrix("1, 0, 0, 0, 0.3, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"),
         "scenes/x.toml:6: object[1].place[1].matrix: stretches or shears the object"},
        {"MatrixOfThreeScales", withMatrix("1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"),
         "scenes/x.toml:6: object[1].place[1].matrix: stretches or shears the object"},
        {"MatrixAndScale", withObject("mesh = { box = { size = [2, 1, 2] } }\nplace = [{ matrix = [1], scale = 2 }]"),
         "scenes/x.toml:6: object[1].place[1].scale: unknown key"},
        {"PhasesOfOtherInstances",
         withObject(
             "mesh = { box = { size = [2, 1, 2] } }\nspin = { axis = [0, 1, 0], degrees_per_frame = 1, phase = [1, 2] }"),
         "scenes/x.toml:6: object[1].spin.phase: expected 1 numbers, one for each instance, got 2"},
        {"PartWithoutAFile", withObject("mesh = { part = \"plate\" }"),
         "scenes/x.toml:5: object[1].mesh.part: belongs to a mesh from a file"},
        {"PartOfAnObj", withObject("mesh = { file = \"x.obj\", part = \"plate\" }"),
         "scenes/x.toml:5: object[1].mesh.file: a part is a mesh of a .gltf or .glb file"},
        {"PointLightOnASurface", withLight("kind = \"point\", centre = [0.2, 0.5, 0.3]"),
         "scenes/x.toml:3: light.centre: the light lies on a surface"},
        {"AreaLightCutsASurface", withLight("kind = \"rectangle\", centre = [1, 0, 0], u = [0.5, 0, 0], v = [0, 0, 0.5]"),
         "scenes/x.toml:3: light.centre: the light lies on a surface"},
        {"EyeInABox", withCamera("eye = [0.3, 0.1, 0.2], target = [0, 0, -3], fovy = 40, near = 0.1, far = 60"),
         "scenes/x.toml:2: camera.eye: the camera is inside a closed mesh"},
        {"EyeMovesIntoABox",
         withCamera("eye = [0, 0.1, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = 0, eye "
                    "= [0, 0.1, 6] }, { frame = 8, eye = [0, 0.1, 0.4] }]"),
         "scenes/x.toml:2: camera.eye: the camera is inside a closed mesh (instance 1) at frame 67"},
        {"NoObjects", "title = \"x\"\n" + kCamera + kLight, "scenes/x.toml:1: the scene has no objects"},
        {"NoObjectInProfile", withObject("mesh = { plane = { half = 2 } }\nprofile = \"paper\""),
         "scenes/x.toml:4: object: no object belongs to profile gate"},
        {"UnknownProfile", withObject("mesh = { plane = { half = 2 } }\nprofile = [\"papre\"]"),
         "scenes/x.toml:6: object[1].profile[1]: expected one of gate, standard, paper, got \"papre\" (did you mean "
         "\"paper\"?)"},
        {"NoValueForProfile", withObject("mesh = { plane = { half = { paper = 2 } } }"),
         "scenes/x.toml:5: object[1].mesh.plane.half: has no value for profile gate"},
        {"UnknownMesh", withObject("mesh = { sphare = { radius = 2 } }"),
         "scenes/x.toml:5: object[1].mesh.sphare: unknown key (did you mean \"sphere\"?)"},
        {"KeyOfAMeshBesideIt", withObject("mesh = { file = \"a.obj\" }\nclosed = true"),
         "scenes/x.toml:6: object[1].closed: belongs in the mesh: mesh = { …, closed = … }"},
        {"TwoMeshes", withObject("mesh = { plane = { half = 2 }, box = { size = [1, 1, 1] } }"),
         "scenes/x.toml:5: object[1].mesh: expected one kind of mesh, got 2"},
        {"NoMesh", withObject("name = \"x\""), "scenes/x.toml:4: object[1].mesh: missing"},
        {"NegativeSize", withObject("mesh = { box = { size = [1, -1, 1] } }"),
         "scenes/x.toml:5: object[1].mesh.box.size: expected 3 numbers above 0"},
        {"ZeroRadius", withObject("mesh = { sphere = { radius = 0, triangles = 80 } }"),
         "scenes/x.toml:5: object[1].mesh.sphere.radius: expected a number above 0, got 0"},
        {"TrianglesNotWhole", withObject("mesh = { sphere = { radius = 1, triangles = 80.5 } }"),
         "scenes/x.toml:5: object[1].mesh.sphere.triangles: expected a whole number, got 80.5"},
        {"TooManyTriangles", withObject("mesh = { sphere = { radius = 1, triangles = 80000000 } }"),
         "scenes/x.toml:5: object[1].mesh.sphere.triangles: expected a whole number from 4 to 4000000, got 80000000"},
        {"BumpAsLargeAsTheRadius", withObject("mesh = { bumpy = { radius = 1, bump = 1, triangles = 80 } }"),
         "scenes/x.toml:5: object[1].mesh.bumpy.bump: expected less than the radius"},
        {"MeshFileMissing", withObject("mesh = { file = \"none.obj\" }"),
         "scenes/x.toml:5: object[1].mesh.file: cannot read scenes/none.obj: No such file"},
        {"LodDistancesShort", withObject("mesh = { sphere = { radius = 1 } }\nlod = { triangles = [80, 20], until = [] }"),
         "scenes/x.toml:6: object[1].lod.until: expected 1 distances"},
        {"LodDistancesShrink",
         withObject("mesh = { sphere = { radius = 1 } }\nlod = { triangles = [320, 80, 20], until = [9, 4] }"),
         "scenes/x.toml:6: object[1].lod.until: the distances of until must grow"},
        {"LodOfABox", withObject("mesh = { box = { size = [1, 1, 1] } }\nlod = { triangles = [80, 20], until = [4] }"),
         "scenes/x.toml:5: object[1].mesh.box: has no levels of detail"},
        {"ColourOutOfRange", withObject("mesh = { plane = { half = 2 } }\ncolour = [1, 2, 0]"),
         "scenes/x.toml:6: object[1].colour: expected 3 numbers from 0 to 1"},
        {"PlaceAndScatter", withObject("mesh = { plane = { half = 2 } }\nplace = [{}]\nscatter = { count = 2, half = 3 }"),
         "scenes/x.toml:7: object[1].scatter: give either place or scatter"},
        {"NegativeScale", withObject("mesh = { plane = { half = 2 } }\nplace = [{ scale = -1 }]"),
         "scenes/x.toml:6: object[1].place[1].scale: expected a number above 0, got -1"},
        {"NoPlace", withObject("mesh = { plane = { half = 2 } }\nplace = []"),
         "scenes/x.toml:6: object[1].place: expected at least one place"},
        {"AbsurdCount", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 100000000, half = 3 }"),
         "scenes/x.toml:6: object[1].scatter.count: expected a whole number from 1 to 100000, got 100000000"},
        {"NoInstances", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 0, half = 3 }"),
         "scenes/x.toml:6: object[1].scatter.count: expected a whole number from 1"},
        {"NoRoomBesideTheCamera",
         withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, clear = 50 }"),
         "scenes/x.toml:6: object[1].scatter: the whole field lies within clear metres"},
        {"SpinAboutNothing",
         withObject("mesh = { plane = { half = 2 } }\nspin = { axis = [0, 0, 0], degrees_per_frame = 3 }"),
         "scenes/x.toml:6: object[1].spin.axis: expected a vector other than zero"},
        {"ShiftMissing", withObject("mesh = { plane = { half = 2 } }\npath = [{ frame = 0 }]"),
         "scenes/x.toml:6: object[1].path[1].shift: missing"},
        {"NegativeTolerance", with(kCamera, kLight, kObject + "[tolerance]\nmismatch = -0.1\n"),
         "scenes/x.toml:7: tolerance.mismatch: expected a number above 0, got -0.1"},
        {"UnknownExpectation", with(kCamera, kLight, kObject + "[expect]\nfail = []\n"),
         "scenes/x.toml:7: expect.fail: unknown key (did you mean \"fails\"?)"},
        {"ExpectationOfNoTechnique", withExpectedFailure("metric = \"leak\", above = 0.1, reason = \"x\""),
         "scenes/x.toml:7: expect.fails[1].technique: missing"},
        {"ExpectationOfAnUnknownMetric",
         withExpectedFailure("technique = \"vsm\", metric = \"laek\", above = 0.1, reason = \"x\""),
         "scenes/x.toml:7: expect.fails[1].metric: expected one of mismatch, mismatch_off_edge, false_shadow, leak"},
        {"ExpectedFailureBelowABound",
         withExpectedFailure("technique = \"vsm\", metric = \"leak\", below = 0.1, reason = \"x\""),
         "scenes/x.toml:7: expect.fails[1].below: unknown key; known are technique, metric, above, reason"},
        {"ExpectationWithoutABound", withExpectedFailure("technique = \"vsm\", metric = \"leak\", reason = \"x\""),
         "scenes/x.toml:7: expect.fails[1].above: missing"},
        {"ExpectationAboveZero", withExpectedFailure("technique = \"vsm\", metric = \"leak\", above = 0, reason = \"x\""),
         "scenes/x.toml:7: expect.fails[1].above: expected a number above 0, got 0"},
        {"ExpectationWithoutAReason",
         withExpectedFailure("technique = \"vsm\", metric = \"leak\", above = 0.1, reason = \"\""),
         "scenes/x.toml:7: expect.fails[1].reason: is empty"},
        {"NoStillFrame", with(kCamera, kLight, kObject + "[timeline]\nstill = 0\n"),
         "scenes/x.toml:7: timeline.still: expected a whole number from 1"},
        {"NoLevels", withObject("levels = []"), "scenes/x.toml:5: object[1].levels: expected at least one level"},
        {"LevelWithoutADistance",
         withObject("levels = [{ mesh = { plane = { half = 2 } } }, { mesh = { plane = { half = 2 } } }]"),
         "scenes/x.toml:5: object[1].levels[1].until: missing"},
        {"LevelsAndLod", withObject("levels = []\nlod = { triangles = [80], until = [] }"),
         "scenes/x.toml:6: object[1].lod: give either levels or lod"},
        {"SimplifyOfAGenerator", withObject("mesh = { simplify = 80 }"),
         "scenes/x.toml:5: object[1].mesh.simplify: belongs to a mesh from a file"},
        {"SimplifyInLod",
         withObject("mesh = { file = \"x.obj\", simplify = 80 }\nlod = { triangles = [80, 20], until = [4] }"),
         "scenes/x.toml:5: object[1].mesh.simplify: the levels of lod state the triangles; leave this one out"},
        {"FlatBox", withObject("mesh = { box = { size = [0, 1, 1] } }"),
         "scenes/x.toml:5: object[1].mesh.box.size: expected 3 numbers above 0"},
        {"BoxOfNoDepth", withObject("mesh = { box = { size = [1, 1, 0] } }"),
         "scenes/x.toml:5: object[1].mesh.box.size: expected 3 numbers above 0"},
        {"ClosedThatIsNoFlag", withObject("mesh = { file = \"x.obj\", closed = \"yes\" }"),
         "scenes/x.toml:5: object[1].mesh.closed: expected true or false, got \"yes\""},
        {"NumberThatIsADate", withObject("mesh = { plane = { half = 2026-11-23 } }"),
         "scenes/x.toml:5: object[1].mesh.plane.half: expected a number, got a date or time"},
        {"NumberThatIsAFlag", withObject("mesh = { plane = { half = false } }"),
         "scenes/x.toml:5: object[1].mesh.plane.half: expected a number, got false"},
        {"HalfAndSpacing", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, spacing = 2 }"),
         "scenes/x.toml:6: object[1].scatter: give either half (sides of the field) or spacing (between instances)"},
        {"HalfOfThreeSides", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = [3, 3, 3] }"),
         "scenes/x.toml:6: object[1].scatter.half: expected a number or 2 (along x and z), got 3"},
        {"JitterBeyondACell", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, jitter = 1.5 }"),
         "scenes/x.toml:6: object[1].scatter.jitter: expected a number from 0 to 1"},
        {"RangeOfThree", withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, turn = [1, 2, 3] }"),
         "scenes/x.toml:6: object[1].scatter.turn: expected a number or 2 that bound a range, got 3"},
        {"RangeTheWrongWayRound",
         withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, scale = [2, 1] }"),
         "scenes/x.toml:6: object[1].scatter.scale: expected the lower end of the range first"},
        {"ScatteredToNothing",
         withObject("mesh = { plane = { half = 2 } }\nscatter = { count = 4, half = 3, scale = [0, 1] }"),
         "scenes/x.toml:6: object[1].scatter.scale: expected numbers above 0"},
        {"UnknownPhase",
         withObject("mesh = { plane = { half = 2 } }\nspin = { axis = [0, 1, 0], degrees_per_frame = 3, phase = \"any\" }"),
         "scenes/x.toml:6: object[1].spin.phase: expected one of random, got \"any\""},
        {"NoObjectInTheProfilesOfAList", withObject("mesh = { plane = { half = 2 } }\nprofile = [\"paper\"]"),
         "scenes/x.toml:4: object: no object belongs to profile gate"},
        {"PathBeforeTheApproach",
         "timeline = { approach = 4 }\n" +
             withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = -5, eye = "
                        "[0, 2, 6] }]"),
         "scenes/x.toml:3: camera.path[1].frame: frames must grow, from -4 (the first of the approach)"},
        {"ShiftAndTargetInAPath",
         withCamera("eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [{ frame = 3, target = "
                    "[0, 2, 6], shift = [1, 0, 0] }]"),
         "scenes/x.toml:2: camera.path[1]: give either shift or eye and target"},
        {"SizeOfThreeSides", withTop("size = [8, 8, 8]"), "scenes/x.toml:1: size: expected a whole number or 2, got 3"},
        {"BandWiderThanTheDistance", with(kCamera, kLight, kObject + "[lod]\nframes = 4\nband = 1.5\n"),
         "scenes/x.toml:8: lod.band: expected a share of the distance, at most 1"},
        {"TwoTransitionsAtOnce",
         withObject("mesh = { sphere = { radius = 1 } }\nlod = { triangles = [320, 80, 20], until = [4, 5] }\n[lod]\n"
                    "frames = 4\nband = 0.5"),
         "scenes/x.toml:9: lod.band: object 1 would be in two transitions at once; make the band narrower"},
        {"PoseOfARigidMesh", withObject("mesh = { plane = { half = 2 } }\npose = 1"),
         "scenes/x.toml:6: object[1].pose: is of a mesh that deforms"},
        {"PoseBeyondTheLast", withObject("mesh = { walker = { triangles = 400, poses = 4 } }\npose = 4"),
         "scenes/x.toml:6: object[1].pose: expected a whole number from 0 to 3, got 4"},
        {"TooFewStartPoses", withObject("mesh = { walker = { triangles = 400, poses = 4 } }\npose = [1, 2]"),
         "scenes/x.toml:6: object[1].pose: expected 1 numbers, one for each instance, got 2"},
        {"LevelsOfDetailOfAMeshThatDeforms",
         withObject(
             "levels = [{ mesh = { walker = { triangles = 400, poses = 4 } }, until = 4 }, { mesh = { plane = { half = 1 "
             "} } }]"),
         "scenes/x.toml:5: object[1].levels[1]: deforms; levels of detail are of rigid meshes"},
        {"WalkPastAMeshThatDeforms",
         withObject("mesh = { walker = { triangles = 400, poses = 4 } }\n[lod]\nframes = 4\nband = 0.5"),
         "scenes/x.toml:6: lod: object 1 deforms; a walk is past rigid meshes"},
        {"PartAndPoses", withObject("mesh = { file = \"x.gltf\", part = \"a\", poses = [\"a\", \"b\"] }"),
         "scenes/x.toml:5: object[1].mesh.part: give either part or poses"},
        {"OnePose", withObject("mesh = { file = \"x.gltf\", poses = [\"a\"] }"),
         "scenes/x.toml:5: object[1].mesh.poses: expected 2 to 1000 names of meshes, got 1"},
        {"NoPixels", withTop("size = 0"), "scenes/x.toml:1: size: expected a whole number from 1 to 8192, got 0"},
    };
    return all;
}

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class LoaderErrors : public testing::TestWithParam<Mistake> {};

TEST_P(LoaderErrors, NameFileLineAndKey) {
    const std::string message = messageOf(GetParam().toml);
    EXPECT_EQ(message.substr(0, GetParam().message.size()), GetParam().message) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(Scene, LoaderErrors, testing::ValuesIn(mistakes()),
                         [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; });

TEST(LoaderErrors, TheSoundSceneThatTheMistakesAreMadeInLoads) { EXPECT_EQ(messageOf(with(kCamera, kLight, kObject)), ""); }

TEST(LoaderErrors, WithoutAListOfMetricsAnyNameWillDo) {
    const std::string text = with(kCamera, kLight, kObject + "[tolerance]\nmissmatch = 0.1\n");
    EXPECT_EQ(parseScene(text, "scenes/x.toml", Profile::Gate).tolerance.at("missmatch"), 0.1);
}

TEST(LoaderErrors, AnUnknownIdNamesTheNearestSceneAndAll) {
    try {
        loadScene("windmils", Profile::Gate);
        FAIL() << "loaded";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"windmills\"?"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("dueling-frusta, overlapping-occluders, simple"), std::string::npos)
            << error.what();
    }
}

TEST(LoaderErrors, AMissingFileAndAFolderAreNamed) {
    for (const auto& [file, reason] :
         {std::pair{"/nowhere/x.toml", "No such file"}, std::pair{"/tmp", "it is a folder"},
          std::pair{"/nowhere/scene.gltf", "No such file"}, std::pair{"/nowhere/scene.glb", "No such file"},
          std::pair{"exported/scene.obj", "folder of an exported scene"}}) {
        try {
            loadScene(file, Profile::Gate);
            ADD_FAILURE() << file << " loaded";
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    }
}

TEST(LoaderErrors, AnUnknownProfileNamesTheKnownOnes) {
    EXPECT_EQ(profileNamed("paper"), Profile::Paper);
    EXPECT_THROW(profileNamed("papers"), BadInput);
}

} // namespace
} // namespace shadowbench
