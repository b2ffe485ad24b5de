// Records as JSON lines.
#include "base/error.h"
#include "base/files.h"
#include "harness/records/fields.h"

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

class Writer {
public:
    Writer(Json& object, std::string path) : object_(object), path_(std::move(path)) { object_ = Json::object(); }

    template <typename T>
    void operator()(const char* key, const T& value) {
        object_[key] = written(key, value);
    }
    template <typename T>
    void operator()(const char* key, const std::optional<T>& value) {
        if (value) (*this)(key, *value);
    }
    void metric(const char* key, const metrics::Metric& line, const metrics::Values& values) {
        const std::vector<double>& list = values.list(metrics::MetricId(line));
        if (values[line])
            object_[key] = number(key, *values[line], line.range.whole);
        else if (!line.optional)
            throw InternalError(fmt::format("writing a record: \"{}\" is missing", pathOf(key)));
        for (const double value : list) object_[key].push_back(number(key, value, line.range.whole));
    }

    template <typename Inner>
    void group(const char* key, bool has, const Inner& inner) {
        if (!has) return;
        Writer writer(object_[key], pathOf(key) + ".");
        inner(writer);
    }

    template <typename T>
    void objects(const char* key, const std::vector<T>& items) {
        for (const T& item : items) object_[key].push_back(written(key, item));
    }

    template <typename T>
    void named(const char* key, const std::map<std::string, T>& items) {
        for (const auto& [name, item] : items) object_[key][name] = written(key, item);
    }

    void text(const char* key, const std::string& value) {
        if (!value.empty()) object_[key] = value;
    }

    void size(const char* key, int width, int height) { object_[key] = {width, height}; }

    void parameters(const char* key, const std::vector<std::pair<std::string, std::string>>& list) {
        Json parameters = Json::object();
        for (const auto& [name, value] : list) {
            const Json number = Json::parse(value, nullptr, false); // "32+32" is no number
            parameters[name] = number.is_number() ? number : Json(value);
        }
        object_[key] = std::move(parameters);
    }

    void figures(const char* key, const std::map<std::string, double>& figures) {
        group(key, !figures.empty(), [&](Writer& inner) {
            for (const auto& [name, value] : figures) inner(name.c_str(), value);
        });
    }

    void bounds(const char* key, const std::map<std::string, double>& bounds) { figures(key, bounds); }

private:
    [[nodiscard]] std::string pathOf(const char* key) const { return path_ + key; }

    [[nodiscard]] Json number(const char* key, double value, bool whole) const {
        const Json json = written(key, value);
        return whole ? Json(static_cast<std::uint64_t>(value)) : json;
    }
    [[nodiscard]] Json written(const char* key, double value) const {
        if (!std::isfinite(value))
            throw InternalError(fmt::format("writing a record: \"{}\" is {}; a metric that has no value must be left out",
                                            pathOf(key), value));
        return value;
    }
    [[nodiscard]] Json written(const char*, Status value) const { return std::string(name(value)); }
    template <typename T>
    [[nodiscard]] Json written(const char* key, const T& value) const {
        if constexpr (requires(Writer & writer) { records::fields(writer, value); }) {
            Json object;
            Writer writer(object, pathOf(key) + ".");
            records::fields(writer, value);
            return object;
        } else {
            return value;
        }
    }

    Json& object_;
    std::string path_;
};

} // namespace

std::string toJson(const Record& record) {
    Json json;
    Writer writer(json, "");
    records::fields(writer, record);
    try {
        return json.dump();
    } catch (const Json::exception&) {
        throw InternalError(
            fmt::format("writing the record of {} on {}: a text is not UTF-8; pass paths and reasons in UTF-8",
                        record.variant, record.scene));
    }
}

void writeRecords(const std::filesystem::path& file, const std::vector<Record>& records) {
    std::string lines;
    for (const Record& record : records) lines += toJson(record) + "\n";
    writeFile(file, lines);
}

} // namespace shadowbench
