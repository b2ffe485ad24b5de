// Draws an exported scene with OpenSceneGraph, its shadow code unmodified: a white diffuse scene is drawn twice, with its
// shadow technique and without, into floats; what is written is the quotient.
#include "../native/exported_scene.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <chrono>
#include <cstdio>
#include <functional>
#include <osg/ComputeBoundsVisitor>
#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Version>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgShadow/SoftShadowMap>
#include <osgShadow/StandardShadowMap>
#include <osgShadow/ViewDependentShadowMap>
#include <osgViewer/Viewer>

namespace {

struct Settings {
    std::string technique = "shadow-map";
    int mapSize = 0;    // 0: the technique's own
    double margin = -1; // below 0: the technique's own
};

using Technique = osg::ref_ptr<osgShadow::ShadowTechnique>;

template <class Map>
Technique mapOfSize(const Settings& settings) {
    osg::ref_ptr<Map> map = new Map;
    if (settings.mapSize > 0) map->setTextureSize(osg::Vec2s(settings.mapSize, settings.mapSize));
    return map;
}

/// By default half of the light stays in a shadow, as ambient light; here none does.
template <class Map>
Technique mapWithoutAmbient(const Settings& settings) {
    Technique map = mapOfSize<Map>(settings);
    static_cast<Map&>(*map).setAmbientBias(osg::Vec2(0, 1));
    return map;
}

template <class Map>
Technique minimalMap(const Settings& settings) {
    Technique map = mapOfSize<Map>(settings);
    if (settings.margin >= 0) static_cast<Map&>(*map).setMinLightMargin(static_cast<float>(settings.margin));
    return map;
}

Technique parallelSplit(const Settings& settings) {
    osg::ref_ptr<osgShadow::ParallelSplitShadowMap> map = new osgShadow::ParallelSplitShadowMap;
    if (settings.mapSize > 0) map->setTextureResolution(settings.mapSize);
    map->setAmbientBias(osg::Vec2(0, 1));
    return map;
}

/// By the words of `--technique`.
const std::map<std::string, std::function<Technique(const Settings&)>> techniques = {
    {"shadow-map", mapWithoutAmbient<osgShadow::ShadowMap>},
    {"soft", mapWithoutAmbient<osgShadow::SoftShadowMap>},
    {"standard", mapOfSize<osgShadow::StandardShadowMap>},
    {"minimal", minimalMap<osgShadow::MinimalShadowMap>},
    {"minimal-cull", minimalMap<osgShadow::MinimalCullBoundsShadowMap>},
    {"minimal-draw", minimalMap<osgShadow::MinimalDrawBoundsShadowMap>},
    {"lispsm-view", minimalMap<osgShadow::LightSpacePerspectiveShadowMapVB>},
    {"lispsm-cull", minimalMap<osgShadow::LightSpacePerspectiveShadowMapCB>},
    {"lispsm-draw", minimalMap<osgShadow::LightSpacePerspectiveShadowMapDB>},
    {"pssm", parallelSplit},
    {"view-dependent", [](const Settings&) -> Technique { return new osgShadow::ViewDependentShadowMap; }},
};

osg::Matrixd matrixOf(const nlohmann::json& numbers) {
    osg::Matrixd matrix; // row vectors times matrices: the transposed of ours, row by row, which are our columns
    for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = numbers.at(i);
    return matrix;
}

osg::Vec3d vectorOf(const nlohmann::json& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

/// Flat triangles. One of an open mesh is there twice, once for each side, and back faces are culled.
osg::ref_ptr<osg::Geometry> makeGeometry(const ExportedMesh& mesh) {
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    const auto add = [&](const Point& a, const Point& b, const Point& c) {
        const osg::Vec3d corners[] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}};
        osg::Vec3d normal = (corners[1] - corners[0]) ^ (corners[2] - corners[0]);
        normal.normalize();
        for (const osg::Vec3d& corner : corners) {
            positions->push_back(corner);
            normals->push_back(normal);
        }
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
        add(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
        if (!mesh.closed) add(mesh.vertices[i], mesh.vertices[i + 2], mesh.vertices[i + 1]);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(positions->size())));
    if (!mesh.closed) geometry->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
    return geometry;
}

osg::ref_ptr<osg::Group> makeNodes(const ExportedScene& exported, const nlohmann::json& frame) {
    static std::map<std::string, osg::ref_ptr<osg::Geometry>> geometries;
    osg::ref_ptr<osg::Group> nodes = new osg::Group;
    for (const nlohmann::json& node : frame.at("nodes")) {
        const std::string name = node.at("mesh");
        osg::ref_ptr<osg::Geometry>& geometry = geometries[name];
        if (!geometry) geometry = makeGeometry(exported.meshes.at(name));
        osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(matrixOf(node.at("matrix")));
        placed->addChild(geometry);
        nodes->addChild(placed);
    }
    osg::ref_ptr<osg::Material> white = new osg::Material;
    white->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    white->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    osg::ref_ptr<osg::LightModel> direct = new osg::LightModel;
    direct->setAmbientIntensity(osg::Vec4(0, 0, 0, 1));
    osg::StateSet& state = *nodes->getOrCreateStateSet();
    state.setAttributeAndModes(white);
    state.setAttributeAndModes(direct);
    state.setMode(GL_NORMALIZE, osg::StateAttribute::ON); // instances are scaled
    state.setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state.setMode(GL_LIGHT0, osg::StateAttribute::ON);
    return nodes;
}

osg::ref_ptr<osg::LightSource> makeLight(const nlohmann::json& light, osg::Group& nodes) {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& made = *source->getLight();
    made.setAmbient(osg::Vec4(0, 0, 0, 1));
    made.setDiffuse(osg::Vec4(1, 1, 1, 1));
    made.setSpecular(osg::Vec4(0, 0, 0, 1));
    if (light.at("kind") == "environment") throw BadInput("no shadow map is of an environment light; choose another scene");
    if (light.at("kind") == "directional") {
        const osg::Vec3d direction = vectorOf(light.at("direction"));
        made.setPosition(osg::Vec4(-direction, 0));
        made.setDirection(direction); // which ParallelSplitShadowMap reads
        return source;
    }
    osg::ComputeBoundsVisitor bounds;
    nodes.accept(bounds);
    const osg::Vec3d centre = vectorOf(light.at("centre"));
    osg::Vec3d towards = osg::Vec3d(bounds.getBoundingBox().center()) - centre;
    towards.normalize();
    made.setPosition(osg::Vec4(centre, 1));
    made.setDirection(towards); // ViewDependentShadowMap's shadow camera looks along it
    return source;
}

/// A context of Mesa without a window, on which OpenSceneGraph draws as in somebody else's window.
void makeContextCurrent() {
    const auto getDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    const EGLDisplay display = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    eglInitialize(display, nullptr, nullptr);
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display, wanted, &config, 1, &found);
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (found == 0 || eglMakeCurrent(display, surface, surface, context) == EGL_FALSE)
        throw std::runtime_error("EGL gives no OpenGL context without a window: is Mesa's libegl-mesa0 installed?");
}

class Drawing {
public:
    Drawing(int width, int height) : image_(new osg::Image) {
        image_->allocateImage(width, height, 1, GL_RGBA, GL_FLOAT);
        image_->setInternalTextureFormat(GL_RGBA32F_ARB);
        viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        viewer_.setUpViewerAsEmbeddedInWindow(0, 0, width, height);
        viewer_.setLightingMode(osg::View::NO_LIGHT);
        osg::Camera& camera = *viewer_.getCamera();
        camera.setClearColor(osg::Vec4(0, 0, 0, 0));
        camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        camera.attach(osg::Camera::COLOR_BUFFER, image_);
        camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
    }

    /// Red at each pixel, rows from the bottom.
    std::vector<float> draw(const nlohmann::json& frame, osgShadow::ShadowedScene& scene, const Technique& technique) {
        scene.setShadowTechnique(technique.get());
        viewer_.setSceneData(&scene);
        viewer_.getCamera()->setViewMatrix(matrixOf(frame.at("view")));
        viewer_.getCamera()->setProjectionMatrix(matrixOf(frame.at("projection")));
        viewer_.frame();
        std::vector<float> red;
        const auto* pixels = reinterpret_cast<const float*>(image_->data());
        for (int i = 0; i < image_->s() * image_->t(); ++i) red.push_back(pixels[4 * i]);
        return red;
    }

private:
    osg::ref_ptr<osg::Image> image_;
    osgViewer::Viewer viewer_;
};

std::vector<float> visibility(Drawing& drawing, const ExportedScene& exported, const nlohmann::json& frame,
                              const Settings& settings) {
    osg::ref_ptr<osg::Group> nodes = makeNodes(exported, frame);
    osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene;
    scene->addChild(nodes);
    scene->addChild(makeLight(frame.at("light"), *nodes));
    if (settings.mapSize > 0) scene->getShadowSettings()->setTextureSize(osg::Vec2s(settings.mapSize, settings.mapSize));
    std::vector<float> shares = drawing.draw(frame, *scene, techniques.at(settings.technique)(settings));
    const std::vector<float> unshadowed = drawing.draw(frame, *scene, nullptr);
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = unshadowed[i] > 0 ? shares[i] / unshadowed[i] : 0;
    return shares;
}

double numberOf(const std::string& name, const std::string& text, double least, double most) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(number >= least && number <= most))
        throw BadInput(name + " " + text + ": give a number from " + std::to_string(least) + " to " + std::to_string(most));
    return number;
}

void printHelp() {
    printUsage("openscenegraph");
    std::cout << "settings, with the engine's own values if not given:\n"
                 "  --technique";
    for (const auto& [name, make] : techniques) std::cout << ' ' << name;
    std::cout << "; shadow-map if not given\n"
                 "  --map-size N  texels along each side of the map\n"
                 "  --margin M    setMinLightMargin of minimal and lispsm maps, in metres\n\n"
                 "example: clients/openscenegraph/render --scene exported --frames 59 --out images\n";
}

void render(Options options) {
    Settings settings;
    if (options.contains("--technique")) settings.technique = options["--technique"];
    if (!techniques.contains(settings.technique))
        throw BadInput("--technique " + settings.technique + ": --help names them");
    if (options.contains("--map-size"))
        settings.mapSize = static_cast<int>(numberOf("--map-size", options["--map-size"], 16, 8192));
    if (options.contains("--margin")) settings.margin = numberOf("--margin", options["--margin"], 0, 1e6);
    const ExportedScene exported = readExportedScene(options["--scene"]);
    const std::vector<nlohmann::json> frames = framesNamed(exported, options["--frames"]);
    makeContextCurrent();
    std::filesystem::create_directories(options["--out"]);
    // Never destroyed: OpenSceneGraph 3.6.5 locks itself up when a viewer ends that drew with a StandardShadowMap.
    Drawing& drawing = *new Drawing(exported.width, exported.height);
    for (const nlohmann::json& frame : frames) {
        const std::string file = options["--out"] + "/frame-" + std::to_string(frame.at("index").get<int>()) + ".pfm";
        writePfm(file, exported.width, exported.height, visibility(drawing, exported, frame, settings));
    }
    std::cout << "openscenegraph: " << frames.size() << " frames into " << options["--out"] << " with OpenSceneGraph "
              << osgGetVersion() << ", " << reinterpret_cast<const char*>(glGetString(GL_RENDERER)) << '\n';
}

} // namespace

int main(int count, char** words) {
    return runClient("openscenegraph", count, words, " --technique --map-size --margin ", printHelp, render);
}
