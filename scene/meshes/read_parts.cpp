// The reader of meshes by name. assimp's rounds matrices and may reorder vertices; here each mesh is as it lies in the file.
#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "scene/meshes/foreign_mesh.h"

#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kTriangles = 4;
constexpr int kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126; // glTF's numbers for the types of components

std::size_t sizeOf(int component) { return component == kByte ? 1 : component == kShort ? 2 : 4; }

/// The numbers of an accessor: `count` elements, `stride` bytes from one to the next.
struct Elements {
    const char* first;
    std::size_t count, stride;
    int component;
};

class Reader {
public:
    explicit Reader(const ForeignMeshFile& file) : file_(file), gltf_(parse(file.bytes)) {}

    [[nodiscard]] std::map<std::string, Mesh> meshes() const {
        if (gltf_.value(Json::json_pointer("/asset/version"), std::string()) != "2.0") fail("it is no glTF 2.0");
        std::map<std::string, Mesh> result;
        for (const Json& mesh : list("meshes")) {
            const std::string name = mesh.value("name", std::string());
            auto read = triangleList(mesh);
            if (read && !name.empty()) result.emplace(name, std::move(*read));
        }
        return result;
    }

    [[noreturn]] static void fail(const std::string& sentence) { throw BadInput(sentence); }

private:
    [[nodiscard]] static Json parse(const std::string& text) {
        try {
            return Json::parse(text);
        } catch (const Json::exception& error) {
            fail(fmt::format("it is not valid JSON ({})", error.what()));
        }
    }

    [[nodiscard]] static std::size_t whole(const Json& number) { return wholeNumber<std::size_t>(number); }

    [[nodiscard]] static std::size_t wholeOr(const Json& object, const char* name, std::size_t otherwise) {
        const auto found = object.find(name);
        return found == object.end() ? otherwise : whole(*found);
    }

    [[nodiscard]] const Json& list(const char* name) const {
        static const Json none = Json::array();
        const auto found = gltf_.find(name);
        return found == gltf_.end() ? none : *found;
    }

    [[nodiscard]] const Json& entry(const char* listName, std::size_t index) const {
        const auto entries = gltf_.find(listName);
        if (entries == gltf_.end() || index >= entries->size()) fail(fmt::format("it has no {}[{}]", listName, index));
        return (*entries)[index];
    }

    [[nodiscard]] const std::string& bytesOf(std::size_t buffer) const {
        const auto uri = entry("buffers", buffer).value("uri", std::string());
        if (uri.empty() || uri.starts_with("data:"))
            fail("a buffer is inside of the file; export it with its buffers beside");
        const auto bytes = file_.buffers.find(uri);
        if (bytes == file_.buffers.end()) fail(fmt::format("the buffer \"{}\" is not there", uri));
        return bytes->second;
    }

    [[nodiscard]] Elements elementsOf(std::size_t accessor, std::size_t components) const {
        const Json& a = entry("accessors", accessor);
        if (!a.contains("bufferView") || a.contains("sparse")) fail(fmt::format("accessors[{}] is sparse", accessor));
        const Json& view = entry("bufferViews", whole(a.at("bufferView")));
        const std::string& bytes = bytesOf(whole(view.at("buffer")));
        const int component = wholeNumber<int>(a.at("componentType"));
        const std::size_t width = components * sizeOf(component), count = whole(a.at("count"));
        const std::size_t stride = wholeOr(view, "byteStride", width);
        const std::size_t first = wholeOr(view, "byteOffset", 0) + wholeOr(a, "byteOffset", 0);
        if (count == 0 || stride < width || first > bytes.size() || count - 1 > (bytes.size() - first) / stride ||
            (count - 1) * stride + width > bytes.size() - first)
            fail(fmt::format("accessors[{}] reaches beyond its buffer", accessor));
        return {bytes.data() + first, count, stride, component};
    }

    /// Nothing for strips, points, lines, several primitives and compressed ones.
    [[nodiscard]] std::optional<Mesh> triangleList(const Json& mesh) const {
        const Json& primitives = mesh.at("primitives");
        if (primitives.size() != 1) return std::nullopt;
        const Json& primitive = primitives[0];
        if (wholeOr(primitive, "mode", kTriangles) != kTriangles || !primitive.contains("indices")) return std::nullopt;
        Mesh result;
        readPositions(elementsOf(whole(primitive.at("attributes").at("POSITION")), 3), result);
        readIndices(elementsOf(whole(primitive.at("indices")), 1), result);
        return result;
    }

    static void readPositions(const Elements& elements, Mesh& mesh) {
        if (elements.component != kFloat) fail("positions are no 32-bit floats");
        mesh.positions.resize(elements.count);
        for (std::size_t i = 0; i < elements.count; ++i)
            std::memcpy(&mesh.positions[i], elements.first + i * elements.stride, sizeof(glm::vec3));
    }

    static void readIndices(const Elements& elements, Mesh& mesh) {
        if (elements.component == kFloat || elements.count % 3 != 0) fail("indices are no list of triangles");
        mesh.triangles.resize(elements.count / 3);
        for (std::size_t i = 0; i < elements.count; ++i) {
            std::uint32_t index = 0; // little-endian, as glTF's buffers are
            std::memcpy(&index, elements.first + i * elements.stride, sizeOf(elements.component));
            mesh.triangles[i / 3][static_cast<int>(i % 3)] = index;
        }
    }

    const ForeignMeshFile& file_;
    Json gltf_;
};

} // namespace

std::map<std::string, Mesh> readPartsHere(const ForeignMeshFile& file) {
    try {
        return Reader(file).meshes();
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(fmt::format("a value is missing or of another kind than glTF asks for ({})", error.what()));
    }
}

} // namespace shadowbench
