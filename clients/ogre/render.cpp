// Draws an exported scene with OGRE, its shadow code unmodified: a white diffuse scene is drawn twice, with its shadow
// technique and without, into floats; what is written is the quotient.
#include "../native/exported_scene.h"

#include <Ogre.h>
#include <OgreRTShaderSystem.h>
#include <OgreSGTechniqueResolverListener.h>
#include <OgreShaderExIntegratedPSSM3.h>
#include <OgreShadowCameraSetupFocused.h>
#include <OgreShadowCameraSetupLiSPSM.h>
#include <OgreShadowCameraSetupPSSM.h>
#include <bit>

namespace {

struct Settings {
    std::string shadows = "stencil";
    std::string camera = "default";
    int mapSize = 512;           // the engine's own
    bool isAsFarAsScene = false; // setShadowFarDistance: not called, or as far as the scene is from the eye
};

Ogre::Affine3 matrixOf(const nlohmann::json& numbers) {
    Ogre::Affine3 matrix = Ogre::Affine3::IDENTITY;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) matrix[row][column] = numbers.at(4 * column + row).get<float>();
    return matrix;
}

Ogre::Vector3 vectorOf(const nlohmann::json& numbers) {
    return {numbers.at(0).get<float>(), numbers.at(1).get<float>(), numbers.at(2).get<float>()};
}

/// Flat triangles. One of an open mesh is there twice, once for each side: back faces are culled.
Ogre::MeshPtr makeMesh(Ogre::SceneManager& scene, const std::string& name, const ExportedMesh& mesh) {
    Ogre::ManualObject& made = *scene.createManualObject();
    made.begin("shadowed");
    unsigned next = 0;
    const auto add = [&](const Point& a, const Point& b, const Point& c) {
        const Ogre::Vector3 corners[] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}};
        const Ogre::Vector3 normal = (corners[1] - corners[0]).crossProduct(corners[2] - corners[0]).normalisedCopy();
        for (const Ogre::Vector3& corner : corners) {
            made.position(corner);
            made.normal(normal);
        }
        made.triangle(next, next + 1, next + 2);
        next += 3;
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
        add(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
        if (!mesh.closed) add(mesh.vertices[i], mesh.vertices[i + 2], mesh.vertices[i + 1]);
    }
    made.end();
    Ogre::MeshPtr converted = made.convertToMesh(name);
    scene.destroyManualObject(&made);
    return converted;
}

/// White and diffuse. Shaders of the engine's shader system are made of it when it is drawn first.
void makeMaterial(const std::string& name, bool receivesShadows) {
    Ogre::MaterialPtr white = Ogre::MaterialManager::getSingleton().create(name, Ogre::RGN_DEFAULT);
    white->setReceiveShadows(receivesShadows);
    white->setAmbient(Ogre::ColourValue::Black);
    white->setDiffuse(Ogre::ColourValue::White);
    white->setSpecular(Ogre::ColourValue::Black);
}

/// Of the world's corners of a frame.
Ogre::AxisAlignedBox boundsOf(const ExportedScene& exported, const nlohmann::json& frame) {
    Ogre::AxisAlignedBox bounds;
    for (const nlohmann::json& node : frame.at("nodes")) {
        const Ogre::Affine3 matrix = matrixOf(node.at("matrix"));
        for (const Point& vertex : exported.meshes.at(node.at("mesh")).vertices)
            bounds.merge(matrix * Ogre::Vector3(vertex[0], vertex[1], vertex[2]));
    }
    return bounds;
}

/// By the words of `--shadows`. In SHADOWTYPE_TEXTURE_ADDITIVE what casts shadows receives none, so here nothing would.
const std::map<std::string, Ogre::ShadowTechnique> techniques = {
    {"stencil", Ogre::SHADOWTYPE_STENCIL_ADDITIVE},
    {"integrated", Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED},
};

/// Three splits between the camera's planes, with the padding and factors of the engine's sample ShaderSystem.
Ogre::ShadowCameraSetupPtr parallelSplits(const nlohmann::json& camera) {
    const auto splits = std::make_shared<Ogre::PSSMShadowCameraSetup>();
    const float near = camera.at("near");
    splits->calculateSplitPoints(3, near, camera.at("far").get<float>());
    splits->setSplitPadding(2 * near);
    splits->setOptimalAdjustFactor(0, 2);
    splits->setOptimalAdjustFactor(1, 1);
    splits->setOptimalAdjustFactor(2, 0.5F);
    return splits;
}

/// By the words of `--camera`.
const std::map<std::string, Ogre::ShadowCameraSetupPtr (*)(const nlohmann::json& camera)> cameras = {
    {"default", [](const nlohmann::json&) { return Ogre::DefaultShadowCameraSetup::create(); }},
    {"focused", [](const nlohmann::json&) { return Ogre::FocusedShadowCameraSetup::create(); }},
    {"lispsm", [](const nlohmann::json&) { return Ogre::LiSPSMShadowCameraSetup::create(); }},
    {"pssm", parallelSplits},
};

/// The engine with the meshes of a scene, and an image of floats that it draws into.
class Engine {
public:
    Engine(const ExportedScene& exported, const Settings& settings)
        : settings_(settings), exported_(exported), root_("", "", "") {
        root_.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
        root_.setRenderSystem(root_.getAvailableRenderers().at(0));
        root_.initialise(false);
        const Ogre::NameValuePairList hidden = {{"hidden", "true"}};
        root_.createRenderWindow("shadowbench", 16, 16, false, &hidden);
        auto& resources = Ogre::ResourceGroupManager::getSingleton();
        for (const char* folder : {"ShadowVolume", "RTShaderLib/GLSL", "RTShaderLib/materials"})
            resources.addResourceLocation(std::string("/usr/share/OGRE/Media/") + folder, "FileSystem", Ogre::RGN_INTERNAL);
        Ogre::RTShader::ShaderGenerator::initialize();
        resources.initialiseAllResourceGroups();
        scene_ = root_.createSceneManager();
        auto& shaders = Ogre::RTShader::ShaderGenerator::getSingleton();
        shaders.addSceneManager(scene_);
        Ogre::MaterialManager::getSingleton().addListener(new OgreBites::SGTechniqueResolverListener(&shaders));
        makeMaterial("shadowed", true);
        makeMaterial("unshadowed", false);
        setUpShadows();
        for (const auto& [name, mesh] : exported.meshes) {
            refuseWhatVolumesCannotNumber(name, makeMesh(*scene_, name, mesh)->getSubMesh(0)->vertexData->vertexCount);
        }
        makeImage();
    }

    std::vector<float> visibility(const nlohmann::json& frame) {
        scene_->clearScene();
        placeCamera(frame);
        for (const nlohmann::json& node : frame.at("nodes"))
            place(*scene_->createEntity(node.at("mesh").get<std::string>()), matrixOf(node.at("matrix")));
        placeLight(frame);
        std::vector<float> shares = draw("shadowed", techniques.at(settings_.shadows));
        const std::vector<float> unshadowed = draw("unshadowed", Ogre::SHADOWTYPE_NONE);
        // The light's pass adds to where surfaces have one depth, as at an edge, more than once: that is fully lit.
        for (std::size_t i = 0; i < shares.size(); ++i)
            shares[i] = unshadowed[i] > 0 ? std::min(1.0F, shares[i] / unshadowed[i]) : 0;
        return shares;
    }

    std::string device() { return root_.getRenderSystem()->getCapabilities()->getDeviceName(); }

private:
    /// Before meshes are made: for stencil shadows they have their edges then.
    void setUpShadows() {
        scene_->setShadowTechnique(techniques.at(settings_.shadows));
        if (settings_.shadows == "stencil") return;
        scene_->setShadowTextureSelfShadow(true); // casters receive, as in the sample
        const nlohmann::json& camera = exported_.frames.at(0).at("camera");
        const Ogre::ShadowCameraSetupPtr setup = cameras.at(settings_.camera)(camera);
        scene_->setShadowCameraSetup(setup);
        const auto* splits = dynamic_cast<const Ogre::PSSMShadowCameraSetup*>(setup.get());
        const unsigned short maps = splits ? 3 : 1;
        scene_->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, maps);
        scene_->setShadowTextureSettings(static_cast<unsigned short>(settings_.mapSize), maps, Ogre::PF_DEPTH16);
        auto& shaders = Ogre::RTShader::ShaderGenerator::getSingleton();
        auto* lookups = static_cast<Ogre::RTShader::IntegratedPSSM3*>(
            shaders.createSubRenderState(Ogre::RTShader::IntegratedPSSM3::Type));
        if (splits) lookups->setSplitPoints(splits->getSplitPoints());
        shaders.getRenderState(Ogre::RTShader::ShaderGenerator::DEFAULT_SCHEME_NAME)->addTemplateSubRenderState(lookups);
    }

    /// The engine's volumes have each vertex twice and 16-bit indices; it ends the program otherwise.
    void refuseWhatVolumesCannotNumber(const std::string& name, std::size_t vertices) const {
        if (settings_.shadows == "stencil" && 2 * vertices > 65536)
            throw BadInput("mesh " + name + " has " + std::to_string(vertices) +
                           " vertices, and stencil shadows take 32768 at most");
    }

    void makeImage() {
        image_ = Ogre::TextureManager::getSingleton().createManual(
            "image", Ogre::RGN_DEFAULT, Ogre::TEX_TYPE_2D, static_cast<unsigned>(exported_.width),
            static_cast<unsigned>(exported_.height), 0, Ogre::PF_FLOAT32_RGBA, Ogre::TU_RENDERTARGET);
        camera_ = scene_->createCamera("camera");
        Ogre::RenderTarget& target = *image_->getBuffer()->getRenderTarget();
        target.setAutoUpdated(false);
        Ogre::Viewport& viewport = *target.addViewport(camera_);
        viewport.setMaterialScheme(Ogre::RTShader::ShaderGenerator::DEFAULT_SCHEME_NAME);
        viewport.setBackgroundColour(Ogre::ColourValue::Black);
    }

    void place(Ogre::MovableObject& object, const Ogre::Affine3& matrix) {
        Ogre::Vector3 position, scale;
        Ogre::Quaternion orientation;
        matrix.decomposition(position, scale, orientation);
        Ogre::SceneNode& node = *scene_->getRootSceneNode()->createChildSceneNode(position, orientation);
        node.setScale(scale);
        node.attachObject(&object);
    }

    void placeCamera(const nlohmann::json& frame) {
        const nlohmann::json& camera = frame.at("camera");
        place(*camera_, matrixOf(frame.at("view")).inverse());
        camera_->setFOVy(Ogre::Degree(camera.at("fovy").get<float>()));
        camera_->setAspectRatio(camera.at("aspect"));
        camera_->setNearClipDistance(camera.at("near"));
        camera_->setFarClipDistance(camera.at("far"));
    }

    void placeLight(const nlohmann::json& frame) {
        const nlohmann::json& described = frame.at("light");
        const std::string kind = described.at("kind");
        if (kind == "environment") throw BadInput("no shadows are of an environment light; choose another scene");
        if (settings_.shadows == "integrated" && settings_.camera == "pssm" && kind != "directional")
            throw BadInput("parallel splits are for directional lights only");
        const Ogre::AxisAlignedBox bounds = boundsOf(exported_, frame);
        if (settings_.isAsFarAsScene) {
            const Ogre::Vector3 eye = vectorOf(frame.at("camera").at("eye"));
            scene_->setShadowFarDistance(bounds.getCenter().distance(eye) + bounds.getHalfSize().length());
        }
        Ogre::Light& light = *scene_->createLight();
        Ogre::SceneNode& node = *scene_->getRootSceneNode()->createChildSceneNode();
        node.attachObject(&light);
        if (kind == "directional") {
            light.setType(Ogre::Light::LT_DIRECTIONAL);
            node.setDirection(vectorOf(described.at("direction")), Ogre::Node::TS_WORLD);
            return;
        }
        light.setType(Ogre::Light::LT_POINT);
        node.setPosition(vectorOf(described.at("centre")));
        if (settings_.shadows != "stencil") refuseScenesAround(node.getPosition(), bounds.getCenter(), frame);
    }

    /// One map is of 120 degrees, and none of the engine's cameras looks to more than one side.
    void refuseScenesAround(const Ogre::Vector3& light, const Ogre::Vector3& middle, const nlohmann::json& frame) {
        float widest = 0;
        for (const nlohmann::json& node : frame.at("nodes")) {
            const Ogre::Affine3 matrix = matrixOf(node.at("matrix"));
            for (const Point& vertex : exported_.meshes.at(node.at("mesh")).vertices) {
                const Ogre::Vector3 to = matrix * Ogre::Vector3(vertex[0], vertex[1], vertex[2]) - light;
                widest = std::max(widest, (middle - light).angleBetween(to).valueDegrees());
            }
        }
        if (widest > 85)
            throw BadInput("the scene is " + std::to_string(static_cast<int>(2 * widest)) +
                           " degrees wide, seen from the light: too much for the one map of a point light");
    }

    /// Red at each pixel, rows from the bottom.
    std::vector<float> draw(const std::string& material, Ogre::ShadowTechnique technique) {
        for (const auto& [name, entity] : scene_->getMovableObjects("Entity"))
            static_cast<Ogre::Entity*>(entity)->setMaterialName(material);
        scene_->setShadowTechnique(technique);
        Ogre::RenderTarget& target = *image_->getBuffer()->getRenderTarget();
        target.update();
        const Ogre::uint32 width = target.getWidth(), height = target.getHeight();
        std::vector<float> pixels(4U * width * height);
        target.copyContentsToMemory(Ogre::Box(0, 0, width, height),
                                    Ogre::PixelBox(width, height, 1, Ogre::PF_FLOAT32_RGBA, pixels.data()));
        std::vector<float> red;
        for (Ogre::uint32 row = height; row-- > 0;)
            for (Ogre::uint32 column = 0; column < width; ++column) red.push_back(pixels[4 * (row * width + column)]);
        return red;
    }

    Settings settings_;
    const ExportedScene& exported_;
    Ogre::Root root_;
    Ogre::SceneManager* scene_ = nullptr;
    Ogre::Camera* camera_ = nullptr;
    Ogre::TexturePtr image_;
};

Settings settingsOf(Options& options) {
    Settings settings;
    const auto word = [&](const std::string& name, std::string& value, const auto& known) {
        if (options.contains(name)) value = options[name];
        if (!known.contains(value)) throw BadInput(name + " " + value + ": --help names them");
    };
    word("--shadows", settings.shadows, techniques);
    word("--camera", settings.camera, cameras);
    if (options.contains("--map-size")) {
        settings.mapSize = std::atoi(options["--map-size"].c_str());
        if (settings.mapSize < 16 || settings.mapSize > 8192 ||
            !std::has_single_bit(static_cast<unsigned>(settings.mapSize)))
            throw BadInput("--map-size " + options["--map-size"] + ": give a power of 2 from 16 to 8192");
    }
    if (options.contains("--distance")) {
        if (options["--distance"] != "scene") throw BadInput("--distance " + options["--distance"] + ": the word is scene");
        settings.isAsFarAsScene = true;
    }
    return settings;
}

void printHelp() {
    printUsage("ogre");
    std::cout << "settings, with the engine's own values if not given:\n"
                 "  --shadows     stencil, or integrated: depth maps that the shader system looks up; stencil if not given\n"
                 "  --camera      of the maps: default, focused, lispsm, or pssm (three splits, with integrated); default "
                 "if not given\n"
                 "  --map-size N  texels along each side of a map: 512 if not given\n"
                 "  --distance scene  setShadowFarDistance, as far as the scene is from the eye\n\n"
                 "example: clients/ogre/render --scene exported --frames 59 --out images\n";
}

void render(Options options) {
    const Settings settings = settingsOf(options);
    const ExportedScene exported = readExportedScene(options["--scene"]);
    const std::vector<nlohmann::json> frames = framesNamed(exported, options["--frames"]);
    std::filesystem::create_directories(options["--out"]);
    // Never destroyed: OGRE 1.12.10 ends itself with an error when its shader system goes after its materials.
    (new Ogre::LogManager)->createLog("", true, false, true);
    Engine& engine = *new Engine(exported, settings);
    for (const nlohmann::json& frame : frames) {
        const std::string file = options["--out"] + "/frame-" + std::to_string(frame.at("index").get<int>()) + ".pfm";
        writePfm(file, exported.width, exported.height, engine.visibility(frame));
    }
    std::cout << "ogre: " << frames.size() << " frames into " << options["--out"] << " with OGRE " << OGRE_VERSION_MAJOR
              << '.' << OGRE_VERSION_MINOR << '.' << OGRE_VERSION_PATCH << ", " << engine.device() << '\n';
}

} // namespace

int main(int count, char** words) {
    return runClient("ogre", count, words, " --shadows --camera --map-size --distance ", printHelp, render);
}
