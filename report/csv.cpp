// Records as comma-separated values (RFC 4180): one column a number or text of the record, lists left out.
#include "harness/records/fields.h"
#include "report/csv_text.h"
#include "report/run_report.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <set>

namespace shadowbench::report {
namespace {

using report::csvText;
std::string csvText(const std::string& text) { return quoted(text); }
std::string csvText(Status status) { return std::string(name(status)); }

template <typename T>
concept Text = requires(const T& value) {
    csvText(value);
};

/// Visits every number and text of a record, there or not, in schema order: collects its column's title and its cell.
class Flattener {
public:
    /// `names`: those of all records that have values under names of their own.
    explicit Flattener(const std::set<std::string>& names) : names_(names) {}

    template <typename T>
    void operator()(const char* key, const T& value) {
        optional(key, &value);
    }
    template <typename T>
    void operator()(const char* key, const std::optional<T>& value) {
        optional(key, value ? &*value : nullptr);
    }
    void metric(const char* key, const metrics::Metric& line, const metrics::Values& values) {
        if (line.list) return;
        const std::optional<double>& value = values[line];
        add(key, !value ? "" : line.range.whole ? csvText(static_cast<std::uint64_t>(*value)) : csvText(*value));
    }
    void operator()(const char*, const std::map<std::string, std::string>&) {}
    void operator()(const char*, const std::optional<OtherScreen>&) {} // passCsv() has them, a row each
    template <typename T>
    void objects(const char*, const std::vector<T>&) {}
    template <typename T>
    void named(const char* key, const std::map<std::string, T>& values) {
        inside(key, true, [&] {
            for (const std::string& name : names_) {
                const auto found = values.find(name);
                optional(name.c_str(), found == values.end() ? nullptr : &found->second);
            }
        });
    }

    template <typename Inner>
    void group(const char* key, bool has, const Inner& inner) {
        inside(key, has, [&] { inner(*this); });
    }
    void text(const char* key, const std::string& value) { add(key, quoted(value)); }
    void size(const char*, int width, int height) {
        add("width", csvText(width));
        add("height", csvText(height));
    }
    void parameters(const char*, const std::vector<std::pair<std::string, std::string>>&) {} // the variant says them
    void figures(const char*, const std::map<std::string, double>&) {}                       // each technique has its own
    void bounds(const char* key, const std::map<std::string, double>& bounds) {
        std::vector<std::string> parts;
        for (const auto& [metric, value] : bounds) parts.push_back(metric + "=" + csvText(value));
        add(key, fmt::format("{}", fmt::join(parts, " ")));
    }

    [[nodiscard]] std::string titles() const { return csvLine(titles_); }
    [[nodiscard]] std::string cells() const { return csvLine(cells_); }

private:
    template <typename T>
    void optional(const char* key, const T* value) {
        if constexpr (Text<T>)
            add(key, value == nullptr ? "" : csvText(*value));
        else
            inside(key, value != nullptr, [&] { records::fields(*this, value == nullptr ? blank<T>() : *value); });
    }

    template <typename Visit>
    void inside(const char* key, bool has, const Visit& visit) {
        const std::string outer = path_;
        const bool wasPresent = present_;
        path_ += std::string(key) + ".";
        present_ = present_ && has;
        visit();
        path_ = outer;
        present_ = wasPresent;
    }

    template <typename T>
    static const T& blank() {
        static const T value{};
        return value;
    }

    void add(const char* key, const std::string& cell) {
        titles_.push_back(path_ + key);
        cells_.push_back(present_ ? cell : "");
    }

    const std::set<std::string>& names_;
    std::string path_;
    bool present_ = true;
    std::vector<std::string> titles_, cells_;
};

} // namespace

std::string csv(const std::vector<Record>& records) {
    std::set<std::string> names;
    for (const Record& record : records)
        for (const auto& [name, cost] : record.modelled) names.insert(name);
    Flattener header(names);
    const Record blank;
    records::fields(header, blank);
    std::string text = header.titles();
    for (const Record& record : records) {
        Flattener row(names);
        records::fields(row, record);
        text += row.cells();
    }
    return text;
}

} // namespace shadowbench::report
