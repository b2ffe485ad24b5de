// Records from JSON lines; strict, so that a typo in a file is an error and not a missing metric.
#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/words.h"
#include "harness/records/fields.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int schemaVersion = 1;
/// Of older records, which timed what each pass needs at least: nothing reads it any more.
constexpr std::string_view retired[]{"cost.time.bare", "cost.time.bare_ratio", "cost.by_pass.bare",
                                     "cost.other_screen.by_pass.bare"};
constexpr std::uint64_t mostCounted = std::uint64_t{1} << 53U; // doubles hold all whole numbers up to here

[[noreturn]] void refuse(const std::string& key, std::string_view complaint) {
    throw BadInput(
        fmt::format("reading a record: \"{}\" {}; it must be a record of schema version {}", key, complaint, schemaVersion));
}

class Reader {
public:
    Reader(const Json& object, std::string path) : object_(object), path_(std::move(path)) {
        if (!object.is_object()) refuse(path_.empty() ? "record" : path_.substr(0, path_.size() - 1), "is not an object");
    }

    template <typename T>
    void operator()(const char* key, T& value) {
        const Json* json = find(key);
        if (json == nullptr) refuse(pathOf(key), "is missing");
        read(key, *json, value);
    }
    template <typename T>
    void operator()(const char* key, std::optional<T>& value) {
        if (const Json* json = find(key)) read(key, *json, value.emplace());
    }
    void metric(const char* key, const metrics::Metric& line, metrics::Values& values) {
        const Json* json = find(key);
        if (json == nullptr && !line.optional) refuse(pathOf(key), "is missing");
        if (json == nullptr) return;
        if (!line.list) values[line] = number(key, *json, line.range.whole);
        if (line.list && !json->is_array()) refuse(pathOf(key), "is not a list");
        if (line.list)
            for (const Json& item : *json)
                values.list(metrics::MetricId(line)).push_back(number(key, item, line.range.whole));
    }

    template <typename Inner>
    void group(const char* key, bool, const Inner& inner) {
        const Json* json = find(key);
        if (json == nullptr) return;
        Reader reader(*json, pathOf(key) + ".");
        inner(reader);
        reader.refuseUnknown();
    }

    template <typename T>
    void objects(const char* key, std::vector<T>& items) {
        const Json* json = find(key);
        if (json == nullptr) return;
        if (!json->is_array()) refuse(pathOf(key), "is not a list");
        for (const Json& item : *json) read(key, item, items.emplace_back());
    }

    template <typename T>
    void named(const char* key, std::map<std::string, T>& items) {
        const Json* json = find(key);
        if (json == nullptr) return;
        if (!json->is_object()) refuse(pathOf(key), "is not an object");
        for (const auto& [name, item] : json->items()) read((std::string(key) + "." + name).c_str(), item, items[name]);
    }

    void text(const char* key, std::string& value) {
        if (const Json* json = find(key)) read(key, *json, value);
    }

    void size(const char* key, int& width, int& height) {
        const Json* json = find(key);
        if (json == nullptr) refuse(pathOf(key), "is missing");
        if (!json->is_array() || json->size() != 2) refuse(pathOf(key), "is not [width, height]");
        read(key, (*json)[0], width);
        read(key, (*json)[1], height);
        if (width < 1 || height < 1) refuse(pathOf(key), "is not [width, height] of a pixel or more");
    }

    void parameters(const char* key, std::vector<std::pair<std::string, std::string>>& list) {
        const Json* json = find(key);
        if (json == nullptr) refuse(pathOf(key), "is missing");
        if (!json->is_object()) refuse(pathOf(key), "is not an object");
        for (const auto& [name, value] : json->items()) {
            if (!value.is_string() && !value.is_number()) refuse(pathOf(key) + "." + name, "is neither a number nor text");
            list.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }

    void figures(const char* key, std::map<std::string, double>& figures) {
        const Json* json = find(key);
        if (json == nullptr) return;
        Reader inner(*json, pathOf(key) + ".");
        for (const auto& [name, value] : json->items()) inner(name.c_str(), figures[name]);
    }

    void bounds(const char* key, std::map<std::string, double>& bounds) { figures(key, bounds); }

    void refuseUnknown() const {
        std::vector<std::string> known(known_.begin(), known_.end());
        for (const auto& [key, value] : object_.items()) {
            if (std::ranges::find(retired, path_ + key) != std::end(retired)) continue;
            if (!known_.contains(key)) refuse(path_ + key, "is unknown" + didYouMean(key, known));
        }
    }

private:
    [[nodiscard]] std::string pathOf(const char* key) const { return path_ + key; }

    const Json* find(const char* key) {
        known_.insert(key);
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }

    [[nodiscard]] double number(const char* key, const Json& json, bool whole) const {
        double value = 0;
        if (!whole) {
            read(key, json, value);
            return value;
        }
        std::uint64_t count = 0;
        read(key, json, count);
        if (count > mostCounted) refuse(pathOf(key), fmt::format("is not within 0 … {}", mostCounted));
        return static_cast<double>(count);
    }

    void read(const char* key, const Json& json, double& value) const {
        if (!json.is_number()) refuse(pathOf(key), "is not a number");
        value = json.get<double>();
    }
    void read(const char* key, const Json& json, bool& value) const {
        if (!json.is_boolean()) refuse(pathOf(key), "is neither true nor false");
        value = json.get<bool>();
    }
    void read(const char* key, const Json& json, std::string& value) const {
        if (!json.is_string()) refuse(pathOf(key), "is not text");
        value = json.get<std::string>();
    }
    void read(const char* key, const Json& json, Status& value) const {
        for (const Status status : {Status::Scored, Status::NotApplicable, Status::ExpectedFailure, Status::Error}) {
            if (!json.is_string() || json.get<std::string>() != name(status)) continue;
            value = status;
            return;
        }
        refuse(pathOf(key), "is not \"scored\", \"not-applicable\", \"expected-failure\" or \"error\"");
    }
    void read(const char* key, const Json& json, std::map<std::string, std::string>& values) const {
        if (!json.is_object()) refuse(pathOf(key), "is not an object");
        for (const auto& [name, item] : json.items()) read(key, item, values[name]);
    }
    template <std::integral T>
    void read(const char* key, const Json& json, T& value) const {
        if (!json.is_number_integer()) refuse(pathOf(key), "is not a whole number");
        const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                                    : std::in_range<T>(json.get<std::int64_t>());
        if (!fits)
            refuse(pathOf(key),
                   fmt::format("is not within {} … {}", std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
        value = json.get<T>();
    }
    template <typename T>
    requires requires(Reader& reader, T& object) { records::fields(reader, object); }
    void read(const char* key, const Json& json, T& object) const {
        Reader reader(json, pathOf(key) + ".");
        records::fields(reader, object);
        reader.refuseUnknown();
    }

    const Json& object_;
    std::string path_;
    std::set<std::string> known_;
};

void requireThisVersion(const Json& json) {
    const auto version = json.find("schema_version");
    if (version == json.end() || !version->is_number_integer()) refuse("schema_version", "is missing or not a whole number");
    if (*version != schemaVersion) refuse("schema_version", "is " + version->dump());
}

/// Older records state the first of the scene's tolerances only, as {"metric": …, "value": …}.
void renewTolerance(Json& object) {
    const auto found = object.find("tolerance");
    if (found == object.end() || object.contains("tolerances")) return;
    std::string metric;
    double value = 0;
    Reader reader(*found, "tolerance.");
    reader("metric", metric);
    reader("value", value);
    reader.refuseUnknown();
    object.erase(found);
    object["tolerances"][metric] = value;
}

} // namespace

Record parseRecord(const std::string& json) {
    Json object = Json::parse(boundedJson(json, "reading a record"), nullptr, false);
    if (object.is_discarded() || !object.is_object()) refuse("record", "is not a JSON object");
    requireThisVersion(object);
    renewTolerance(object);
    Record record;
    Reader reader(object, "");
    records::fields(reader, record);
    reader.refuseUnknown();
    if (isLevelOfDetail(record) && !wasScored(record.status))
        refuse("lod", "belongs to scored records and expected failures, and to no others");
    if (object.contains("accuracy") != records::hasAccuracy(record))
        refuse("accuracy", "belongs to scored records and expected failures without \"lod\", and to no others");
    return record;
}

std::vector<Record> readRecords(const std::filesystem::path& file) {
    const std::string text = readFile(file);
    std::vector<Record> records;
    int line = 0;
    for (std::size_t start = 0; start < text.size();) {
        ++line;
        const std::size_t end = text.find('\n', start);
        if (end == std::string::npos)
            throw BadInput(fmt::format("{}:{}: the last line has no end: the file was cut short; delete the line",
                                       file.string(), line));
        try {
            records.push_back(parseRecord(text.substr(start, end - start)));
        } catch (const BadInput& error) {
            throw BadInput(fmt::format("{}:{}: {}", file.string(), line, error.what()));
        }
        start = end + 1;
    }
    return records;
}

} // namespace shadowbench
