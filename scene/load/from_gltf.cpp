// Scene files whose objects are those of a glTF file.
#include "base/error.h"
#include "scene/exchange/gltf.h"
#include "scene/load/scene_file.h"

namespace shadowbench {
namespace {

/// A view that the scene file has itself, or the name of one of the glTF file.
void readView(const TomlValue& root, const char* key, toml::table& own, bool& isOwn, std::optional<std::string>& name) {
    const auto value = root.find(key);
    isOwn = value && !value->isText();
    if (!value || isOwn) return;
    name = value->text();
    own.erase(key); // for the glTF file's to take its place
}

/// Copies in what `own` lacks, and the objects before its own. What is copied forgets its line, which is in no file.
void complete(toml::table& own, const toml::table& gltf) {
    for (const auto& [key, value] : gltf)
        if (key != "object") own.insert(key, value);
    const toml::array& objects = *gltf["object"].as_array();
    toml::node* list = own.get("object");
    if (list == nullptr) {
        own.insert("object", objects);
        return;
    }
    if (!list->is_array()) return; // a mistake that the reader of objects names
    toml::array& all = *list->as_array();
    all.insert(all.begin(), objects.begin(), objects.end());
}

} // namespace

void completeFromGltf(toml::table& own, const TomlSource& source, const std::filesystem::path& folder) {
    const TomlValue root(source, "", own);
    const auto gltf = root.find("gltf"), unit = root.find("unit"), up = root.find("up"), texels = root.find("mask_texels");
    for (const auto& key : {unit, up, texels})
        if (key && !gltf) key->fail("belongs to gltf = \"FILE\", and within mesh = { … } to a mesh from a file");
    if (!gltf) return;
    exchange::GltfUse use{.file = gltf->text()};
    if (unit) use.metres = metresOf(*unit);
    use.zUp = up && isZUp(*up);
    if (texels) use.maskTexels = maskTexelsOf(*texels);
    readView(root, "camera", own, use.hasCamera, use.camera);
    readView(root, "light", own, use.hasLight, use.light);
    std::string made;
    try {
        made = exchange::sceneOfGltf(folder / use.file, use).toml;
    } catch (const BadInput& error) {
        gltf->fail(error.what());
    }
    complete(own, parseToml(made, source.file));
    for (const char* read : {"gltf", "unit", "up", "mask_texels"}) own.erase(read);
}

} // namespace shadowbench
