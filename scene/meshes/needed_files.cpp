// The one look that the parent takes into a .gltf: which files its meshes need. The parser calls us value by value, and the
// file's text is not kept.
#include "base/confined/passed_descriptors.h"
#include "base/error.h"
#include "base/limits.h"
#include "scene/meshes/foreign_mesh.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

/// Collects the names of buffers, and those of the textures that alpha tests read.
class FileNames : public nlohmann::json_sax<Json> {
public:
    /// Each once.
    [[nodiscard]] std::vector<std::string> needed() const {
        std::vector<std::string> names;
        const auto need = [&](const std::string& name) {
            if (name.empty() || name.starts_with("data:") || std::ranges::find(names, name) != names.end()) return;
            if (names.size() + 1 == kMostPassed) // with the .gltf itself
                throw BadInput(fmt::format("it needs more than {} files", kMostPassed - 1));
            names.push_back(name);
        };
        for (const auto& [index, name] : buffers_) need(name);
        for (const std::size_t material : masked_)
            if (const auto texture = textures_.find(material); texture != textures_.end())
                if (const auto image = sources_.find(texture->second); image != sources_.end())
                    if (const auto name = images_.find(image->second); name != images_.end()) need(name->second);
        return names;
    }

    bool null() override { return passed(); }
    bool boolean(bool) override { return passed(); }
    bool number_integer(number_integer_t) override { return passed(); }
    bool number_float(number_float_t, const string_t&) override { return passed(); }
    bool binary(binary_t&) override { return passed(); }
    bool start_object(std::size_t) override { return enter({.key = {}}); }
    bool end_object() override { return leave(); }
    bool start_array(std::size_t) override { return enter({.key = {}, .isList = true}); }
    bool end_array() override { return leave(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

    bool key(string_t& key) override {
        levels_.back().key = key;
        return true;
    }

    bool number_unsigned(number_unsigned_t number) override {
        if (isAt("materials", "pbrMetallicRoughness", "baseColorTexture", "index")) textures_[element()] = number;
        if (isAt("textures", "source")) sources_[element()] = number;
        return passed();
    }

    bool string(string_t& text) override {
        if (isAt("buffers", "uri")) buffers_[element()] = text;
        if (isAt("images", "uri")) images_[element()] = text;
        if (isAt("materials", "alphaMode") && text == "MASK") masked_.insert(element());
        return passed();
    }

private:
    struct Level {
        std::string key;
        bool isList = false;
        std::size_t index = 0;
    };

    /// Whether what comes is this member of an element of that list of the file.
    template <typename... Keys>
    [[nodiscard]] bool isAt(const char* list, Keys... keys) const {
        if (levels_.size() != 2 + sizeof...(keys) || levels_[0].key != list || !levels_[1].isList) return false;
        std::size_t level = 2;
        return ((levels_[level++].key == keys) && ...);
    }
    [[nodiscard]] std::size_t element() const { return levels_[1].index; }

    bool enter(Level level) {
        levels_.push_back(std::move(level));
        if (levels_.size() > limitOf(Limit::Nesting))
            throw BadInput(
                fmt::format("its lists and objects are nested {} deep, {}", levels_.size(), beyond(Limit::Nesting)));
        return true;
    }
    bool leave() {
        levels_.pop_back();
        return passed();
    }
    /// After a value.
    bool passed() {
        if (!levels_.empty() && levels_.back().isList) ++levels_.back().index;
        return true;
    }

    std::vector<Level> levels_;
    std::map<std::size_t, std::string> buffers_, images_;   // names by number
    std::map<std::size_t, std::size_t> textures_, sources_; // of a material its texture, of a texture its image
    std::set<std::size_t> masked_;                          // materials
};

} // namespace

std::vector<std::string> filesNeededBy(std::string_view gltf) {
    FileNames found;
    Json::sax_parse(gltf, &found);
    return found.needed();
}

} // namespace shadowbench
