#include "scene/meshes/gltf_buffers.h"

#include "base/base64.h"
#include "base/error.h"
#include "base/json_text.h"
#include "scene/gltf_file.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

constexpr int kByte = 5121, kShort = 5123; // glTF's numbers for the types of components

GltfJson parsed(std::string_view text) {
    try {
        return GltfJson::parse(text);
    } catch (const GltfJson::exception& error) {
        throw BadInput(fmt::format("it is not valid JSON ({})", error.what()));
    }
}

/// The bytes that a data URI carries.
std::string decoded(std::string_view uri, const char* list, std::size_t index) {
    constexpr std::string_view mark = ";base64,";
    const std::size_t at = uri.find(mark);
    std::optional<std::string> bytes;
    if (at != std::string_view::npos) bytes = fromBase64(uri.substr(at + mark.size()));
    if (!bytes) throw BadInput(fmt::format("the data URI of {}[{}] is no base64; export it as .glb", list, index));
    return std::move(*bytes);
}

} // namespace

std::size_t sizeOfComponent(int component) { return component == kByte ? 1 : component == kShort ? 2 : 4; }

const GltfJson& gltfList(const GltfJson& object, const char* name) {
    static const GltfJson none = GltfJson::array();
    const auto found = object.find(name);
    if (found == object.end()) return none;
    if (!found->is_array()) throw BadInput(fmt::format("\"{}\" is no list; export it again", name));
    return *found;
}

std::size_t gltfWhole(const GltfJson& object, const char* name, std::size_t otherwise) {
    const auto found = object.find(name);
    return found == object.end() ? otherwise : wholeNumber<std::size_t>(*found);
}

GltfBuffers::GltfBuffers(const ForeignMeshFile& file) : file_(file) {
    std::string_view text = file.bytes;
    if (file.extension == ".glb") {
        const GlbChunks chunks = glbChunks(text);
        text = chunks.json;
        binary_ = chunks.binary;
    }
    json_ = parsed(text);
    if (json_.value(GltfJson::json_pointer("/asset/version"), std::string()) != "2.0") throw BadInput("it is no glTF 2.0");
    for (const GltfJson& extension : gltfList(json_, "extensionsRequired")) requireHarmless(extension.get<std::string>());
}

const GltfJson& GltfBuffers::entry(const char* list, std::size_t index) const {
    const GltfJson& entries = gltfList(json_, list);
    if (index >= entries.size()) throw BadInput(fmt::format("it has no {}[{}]; export it again", list, index));
    return entries[index];
}

std::string_view GltfBuffers::bytesOf(std::size_t buffer) {
    const auto uri = entry("buffers", buffer).value("uri", std::string());
    if (uri.empty()) {
        if (buffer != 0 || file_.extension != ".glb") throw BadInput(fmt::format("buffers[{}] names no file", buffer));
        return binary_;
    }
    if (uri.starts_with("data:")) {
        const auto [known, isNew] = decoded_.try_emplace(buffer);
        if (isNew) known->second = decoded(uri, "buffers", buffer);
        return known->second;
    }
    return handed(uri);
}

std::string_view GltfBuffers::handed(const std::string& uri) const {
    const auto bytes = file_.buffers.find(uri);
    if (bytes == file_.buffers.end()) throw BadInput(fmt::format("the file \"{}\" is not there", uri));
    return bytes->second;
}

std::string_view GltfBuffers::bytesOfView(std::size_t number) {
    const GltfJson& view = entry("bufferViews", number);
    const std::string_view buffer = bytesOf(wholeNumber<std::size_t>(view.at("buffer")));
    const std::size_t start = gltfWhole(view, "byteOffset", 0);
    if (start > buffer.size() || gltfWhole(view, "byteLength", 0) > buffer.size() - start)
        throw BadInput(fmt::format("bufferViews[{}] reaches beyond its buffer", number));
    return buffer.substr(start, gltfWhole(view, "byteLength", buffer.size() - start));
}

std::string GltfBuffers::image(std::size_t index) {
    const GltfJson& image = entry("images", index);
    if (image.contains("bufferView")) return std::string(bytesOfView(wholeNumber<std::size_t>(image["bufferView"])));
    const auto uri = image.at("uri").get<std::string>();
    return uri.starts_with("data:") ? decoded(uri, "images", index) : std::string(handed(uri));
}

GltfElements GltfBuffers::elements(std::size_t accessor, std::string_view type) {
    const GltfJson& a = entry("accessors", accessor);
    const auto fail = [&](const std::string& sentence) {
        throw BadInput(fmt::format("accessors[{}] {}", accessor, sentence));
    };
    if (!a.contains("bufferView") || a.contains("sparse")) fail("is sparse or has no bufferView; export it whole");
    if (a.at("type").get<std::string>() != type) fail(fmt::format("is of type {}, not {}", a["type"].dump(), type));
    const auto viewNumber = wholeNumber<std::size_t>(a.at("bufferView"));
    const std::string_view bytes = bytesOfView(viewNumber);
    const int component = wholeNumber<int>(a.at("componentType"));
    const std::size_t width = (type == "VEC3" ? 3 : type == "VEC2" ? 2 : 1) * sizeOfComponent(component);
    const std::size_t count = wholeNumber<std::size_t>(a.at("count")),
                      stride = gltfWhole(entry("bufferViews", viewNumber), "byteStride", width);
    const std::size_t first = gltfWhole(a, "byteOffset", 0);
    if (count == 0) fail("is empty");
    if (stride < width || first > bytes.size() || count - 1 > (bytes.size() - first) / stride ||
        (count - 1) * stride + width > bytes.size() - first)
        fail("reaches beyond its bufferView");
    return {bytes.data() + first, count, stride, component};
}

} // namespace shadowbench
