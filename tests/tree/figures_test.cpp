// The figures on the front page and in the findings are those of the records that they name.
//
// A table is held to its records when a line above it names them, as in
//   Ten rows of `dueling-frusta` ([records](../results/published/results.jsonl)):
// its first column has variants between backticks, and the other columns that have a path into the record between backticks
// are compared: `accuracy.mismatch`, `stability.by_frame.rmse[20]` (counted from 1).
#include "base/files.h"
#include "tests/support/citations.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

namespace shadowbench {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path root = SOURCE_FOLDER;

/// What stands between two marks; nothing without them.
std::optional<std::string> between(const std::string& text, const std::string& open, const std::string& close) {
    const std::size_t begin = text.find(open);
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t end = text.find(close, begin + open.size());
    if (end == std::string::npos) return std::nullopt;
    return text.substr(begin + open.size(), end - begin - open.size());
}

std::vector<std::string> cellsOf(const std::string& row) {
    std::vector<std::string> cells;
    for (std::size_t at = 1; at < row.size();) {
        const std::size_t end = std::min(row.find('|', at), row.size());
        const std::size_t first = row.find_first_not_of(' ', at);
        const std::size_t last = row.find_last_not_of(' ', end - 1);
        cells.push_back(first < end ? row.substr(first, last + 1 - first) : "");
        at = end + 1;
    }
    return cells;
}

std::vector<Json> recordsOf(const fs::path& file) {
    std::vector<Json> records;
    for (const std::string& line : citations::linesOf(readFile(file)))
        if (!line.empty()) records.push_back(Json::parse(line));
    return records;
}

/// The number at a path such as "cost.time.ratio"; nothing where the record has none.
std::optional<double> numberAt(const Json& record, std::string path) {
    std::size_t index = 0;
    if (const auto place = between(path, "[", "]")) {
        index = std::stoul(*place);
        path = path.substr(0, path.find('['));
    }
    std::replace(path.begin(), path.end(), '.', '/');
    const Json::json_pointer pointer("/" + path);
    if (!record.contains(pointer)) return std::nullopt;
    const Json& value = record.at(pointer);
    if (index == 0) return value.get<double>();
    return value.at(index - 1).get<double>();
}

/// `value` as it would be written in place of `shown`: as many decimals, per cent or not.
std::string asShown(const std::string& shown, std::optional<double> value) {
    if (!value) return "–";
    const std::string number = shown.substr(0, shown.find(' '));
    const std::size_t point = number.find('.');
    const std::size_t decimals = point == std::string::npos ? 0 : number.size() - point - 1;
    return shown.ends_with(" %") ? fmt::format("{:.{}f} %", 100 * *value, decimals)
                                 : fmt::format("{:.{}f}", *value, decimals);
}

struct Checked {
    int figures = 0;
    std::string wrong;
};

class Page {
public:
    explicit Page(std::string file) : file_(std::move(file)) {}

    Checked check(const std::string& text) {
        Checked checked;
        for (const std::string& line : citations::linesOf(text)) {
            if (const auto target = between(line, "[records](", ")")) {
                records_ = recordsOf(root / fs::path(file_).parent_path() / *target);
                scene_ = between(line, "`", "`").value_or("");
                columns_.clear();
            } else if (!line.starts_with('|')) {
                columns_.clear();
                if (!line.empty()) records_.clear();
            } else if (columns_.empty()) {
                for (const std::string& head : cellsOf(line)) columns_.push_back(between(head, "`", "`"));
            } else if (!line.starts_with("|---") && !records_.empty()) {
                checkRow(cellsOf(line), checked);
            }
        }
        return checked;
    }

private:
    void checkRow(const std::vector<std::string>& cells, Checked& checked) const {
        const std::string variant = between(cells.at(0), "`", "`").value_or("");
        const auto found = std::ranges::find_if(
            records_, [&](const Json& record) { return record.at("scene") == scene_ && record.at("variant") == variant; });
        if (found == records_.end()) {
            checked.wrong += fmt::format("\n  {}: no record of \"{}\" on \"{}\"", file_, variant, scene_);
            return;
        }
        for (std::size_t i = 1; i < cells.size(); ++i) {
            if (i >= columns_.size() || !columns_[i] || cells[i].empty()) continue;
            ++checked.figures;
            const std::string expected = asShown(cells[i], numberAt(*found, *columns_[i]));
            if (cells[i] != expected)
                checked.wrong += fmt::format("\n  {}: {} of {} on {} is {}, not {}", file_, *columns_[i], variant, scene_,
                                             expected, cells[i]);
        }
    }

    std::string file_, scene_;
    std::vector<Json> records_;
    std::vector<std::optional<std::string>> columns_;
};

TEST(Figures, OfPagesAreThoseOfTheRecords) {
    for (const std::string file : {"README.md", "docs/findings.md"}) {
        const Checked checked = Page(file).check(readFile(root / file));
        EXPECT_GT(checked.figures, 10) << file << ": no tables found";
        EXPECT_TRUE(checked.wrong.empty()) << checked.wrong;
    }
}

TEST(Figures, ThatHaveChangedAreNamed) {
    const std::string page = "`dueling-frusta`, [records](results/published/results.jsonl):\n\n"
                             "| variant | `accuracy.mismatch` | `accuracy.psnr` | remark |\n|---|--:|--:|---|\n";
    const Checked wrong = Page("page.md").check(page + "| `sm-uniform` | 77.7 % | – | any |\n| `sm-gone` | 1 % | – | |\n");
    EXPECT_EQ(wrong.figures, 2);
    EXPECT_TRUE(std::regex_search(wrong.wrong,
                                  std::regex("accuracy.mismatch of sm-uniform on dueling-frusta is [0-9.]+ %, not 77.7 %")))
        << wrong.wrong;
    EXPECT_NE(wrong.wrong.find("no record of \"sm-gone\""), std::string::npos);
    EXPECT_EQ(wrong.wrong.find("psnr"), std::string::npos) << "absent, and shown as absent";
}

} // namespace
} // namespace shadowbench
