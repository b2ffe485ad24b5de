// The one look that the parent takes into a .gltf: which files it names. The parser calls us value by value and keeps
// nothing.
#include "base/confined/passed_descriptors.h"
#include "base/error.h"
#include "base/limits.h"
#include "scene/meshes/foreign_mesh.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

/// Collects the texts at /buffers/*/uri.
class BufferNames : public nlohmann::json_sax<Json> {
public:
    std::vector<std::string> names;

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return enter(); }
    bool end_object() override { return leave(); }
    bool start_array(std::size_t) override { return enter(); }
    bool end_array() override { return leave(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

    bool key(string_t& key) override {
        if (depth_ == 1) inBuffers_ = key == "buffers";
        isUri_ = depth_ == 3 && key == "uri";
        return true;
    }

    bool string(string_t& text) override {
        if (!inBuffers_ || depth_ != 3 || !isUri_ || text.empty() || text.starts_with("data:")) return true;
        if (std::ranges::find(names, text) != names.end()) return true;
        if (names.size() + 1 == kMostPassed) // with the .gltf itself
            throw BadInput(fmt::format("it names more than {} buffers", kMostPassed - 1));
        names.push_back(text);
        return true;
    }

private:
    bool enter() {
        if (++depth_ > limitOf(Limit::Nesting))
            throw BadInput(fmt::format("its lists and objects are nested {} deep, {}", depth_, beyond(Limit::Nesting)));
        return true;
    }
    bool leave() {
        --depth_;
        return true;
    }

    std::uint64_t depth_ = 0;
    bool inBuffers_ = false, isUri_ = false;
};

} // namespace

std::vector<std::string> bufferNamesOf(std::string_view gltf) {
    BufferNames found;
    Json::sax_parse(gltf, &found);
    return found.names;
}

} // namespace shadowbench
