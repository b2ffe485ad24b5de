#include "site/table.h"

#include "report/csv_text.h"
#include "report/families.h"
#include "site/names.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

Data columnData(const Column& column) {
    Data data;
    data.set("title", column.title);
    data.set("hint", column.hint);
    data.set("key", column.key);
    data.set("unit", column.unit);
    data.set("number", column.number);
    return data;
}

Data cellData(const Cell& cell, const Column& column, const std::string& root) {
    Data data;
    data.set("text", truncate(cell.text, column.prose ? sentenceRoom : nameRoom));
    data.set("under", column.title);
    data.set("value", cell.value && std::isfinite(*cell.value) ? fmt::format("{}", *cell.value) : std::string());
    data.set("valued", cell.value.has_value());
    data.set("linked", !cell.address.empty());
    data.set("address", root + cell.address);
    data.set("small", truncate(cell.small));
    data.set("printed", !cell.small.empty());
    data.set("kind", cell.kind + (column.number ? " number" : ""));
    data.set("noted", !cell.note.empty());
    data.set("note", truncate(cell.note, sentenceRoom));
    return data;
}

/// A name as HTML that a narrow column breaks between a variant's parameters and not within a word.
std::string breakable(const std::string& text) {
    std::string html;
    for (const char letter : kainjow::mustache::html_escape(text)) {
        html += letter;
        if (letter == ':' || letter == ',' || letter == '=' || letter == '_' || letter == '.') html += "<wbr>";
    }
    return html;
}

Data rowData(const Row& row, const Table& table, const std::string& root) {
    Data data, marks{Data::type::list}, cells{Data::type::list};
    for (const auto& [name, value] : row.marks) {
        Data mark;
        mark.set("name", name);
        mark.set("mark", truncate(value));
        marks << mark;
    }
    data.set("marks", marks);
    data.set("head", cellData(row.cells.front(), Column{.title = {}, .number = false}, root));
    data.set("name", breakable(truncate(row.cells.front().text)));
    for (std::size_t i = 1; i < row.cells.size(); ++i) cells << cellData(row.cells[i], table.columns[i], root);
    data.set("cells", cells);
    return data;
}

std::vector<std::size_t> columnsOf(const Table& table, bool brief) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (!brief || table.columns[i].brief) chosen.push_back(i);
    return chosen;
}

/// The characters that tables hold and LaTeX has other words for.
constexpr std::pair<std::string_view, std::string_view> latexWords[] = {
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"\"", "''"}, // \textquotedbl is not in TeX's own fonts
    {"`", "\\textasciigrave{}"},
    {"[", "{[}"},
    {"]", "{]}"},
    {"\n", " "},
    {"\r", " "},
    {"\t", " "},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\dots{}"},
    {"×", "$\\times$"},
    {"²", "$^2$"},
    {"≤", "$\\le$"},
    {"≥", "$\\ge$"},
    {"σ", "$\\sigma$"},
    {"●", "$\\bullet$"},
    {"○", "$\\circ$"},
    {"°", "$^\\circ$"},
    {"·", "$\\cdot$"},
    {"→", "$\\to$"},
};

std::size_t characterLength(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Latin letters with accents, which inputenc knows: U+00C0 … U+017F.
bool isLatin(std::string_view letter) {
    const auto lead = static_cast<unsigned char>(letter.front());
    return letter.size() == 2 && lead >= 0xC3 && lead <= 0xC5;
}

std::string latexCharacter(std::string_view letter) {
    for (const auto& [character, word] : latexWords)
        if (character == letter) return std::string(word);
    if (letter.size() == 1) return static_cast<unsigned char>(letter.front()) < 0x20 ? "" : std::string(letter);
    return isLatin(letter) ? std::string(letter) : "?";
}

/// "4.87 %" → 4.87; nothing where no number leads.
std::optional<double> leadingNumber(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return end == text.c_str() || !std::isfinite(value) ? std::nullopt : std::optional(value);
}

/// The families of the rows, in the order in which all pages list them.
Data familiesOf(const Table& table) {
    Data list{Data::type::list};
    for (const report::Family& family : report::families()) {
        const std::pair<std::string, std::string> mark{"family", family.id};
        const auto isOfIt = [&](const Row& row) { return std::ranges::find(row.marks, mark) != row.marks.end(); };
        if (std::ranges::none_of(table.rows, isOfIt)) continue;
        Data entry;
        entry.set("family", family.id);
        entry.set("title", family.title);
        list << entry;
    }
    return list;
}

Data scaleOf(const Table& table) {
    Data list{Data::type::list};
    for (const auto& [kind, words] : table.scale) {
        Data entry;
        entry.set("kind", kind);
        entry.set("words", words);
        list << entry;
    }
    return list;
}

} // namespace

Table tableOf(const report::TextTable& text, const std::string& id, const std::string& caption) {
    Table table{.id = id, .caption = caption, .columns = {}, .rows = {}};
    for (const std::string& title : text.titles) table.columns.push_back({.title = title, .number = !table.columns.empty()});
    for (const std::vector<std::string>& cells : text.rows) {
        Row& row = table.rows.emplace_back();
        for (const std::string& cell : cells)
            row.cells.push_back({cell, row.cells.empty() ? std::nullopt : leadingNumber(cell)});
    }
    return table;
}

Data tableData(const Table& table, const std::string& root, const std::string& files) {
    Data data, columns{Data::type::list}, rows{Data::type::list};
    data.set("id", table.id);
    data.set("caption", table.caption);
    data.set("headed", table.headed);
    data.set("filtered", table.filtered);
    data.set("tablenote", table.note);
    data.set("files", root + files);
    data.set("stacked", table.stacked || std::ranges::any_of(table.columns, &Column::prose));
    for (const Column& column : table.columns) columns << columnData(column);
    for (const Row& row : table.rows) rows << rowData(row, table, root);
    data.set("columns", columns);
    data.set("rows", rows);
    const Data families = familiesOf(table), scale = scaleOf(table);
    data.set("keyed", families.is_non_empty_list() || scale.is_non_empty_list());
    data.set("families", families);
    data.set("scale", scale);
    return data;
}

std::string csvOf(const Table& table) {
    std::vector<std::string> titles;
    for (const Column& column : table.columns) titles.push_back(report::quoted(column.title));
    std::string text = report::csvLine(titles);
    for (const Row& row : table.rows) {
        std::vector<std::string> cells;
        for (const Cell& cell : row.cells)
            cells.push_back(cell.value ? report::csvText(*cell.value) : cell.text == "–" ? "" : report::quoted(cell.text));
        text += report::csvLine(cells);
    }
    return text;
}

std::string latexText(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = std::min(characterLength(text[i]), text.size() - i);
        result += latexCharacter(std::string_view(text).substr(i, length));
        i += length;
    }
    return result;
}

namespace {

bool isBaselineRow(const Row& row) {
    return std::ranges::find(row.marks, std::pair<std::string, std::string>("baseline", "yes")) != row.marks.end();
}

/// The best value of each column that has one.
std::vector<std::optional<double>> bestOf(const Table& table) {
    std::vector<std::optional<double>> best(table.columns.size());
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        for (const Row& row : table.rows) {
            const std::optional<double>& value = row.cells[i].value;
            if (table.columns[i].least && value && !isBaselineRow(row) && (!best[i] || *value < *best[i])) best[i] = value;
        }
    return best;
}

std::string latexCell(const Cell& cell, const Column& column) {
    const std::string& text = cell.name.empty() ? cell.text : cell.name;
    return text.empty() ? "{}" : latexText(truncate(text, column.prose ? sentenceRoom : nameRoom));
}

} // namespace

std::string latexOf(const Table& table, bool brief, const std::string& label) {
    const std::vector<std::size_t> chosen = columnsOf(table, brief);
    std::string kinds, titles;
    for (const std::size_t i : chosen) {
        kinds += i > 0 && table.columns[i].number ? 'r' : 'l';
        titles += (titles.empty() ? "" : " & ") + latexText(table.columns[i].title);
    }
    std::string text = "% needs: \\usepackage[utf8]{inputenc} \\usepackage{textcomp,booktabs,graphicx}\n"
                       "\\begin{table}\n  \\centering\n";
    text += fmt::format("  \\caption{{{}}}\n  \\label{{tab:{}}}\n", latexText(truncate(table.caption)), label);
    text += fmt::format("  \\resizebox{{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}}{{!}}{{%\n"
                        "  \\begin{{tabular}}{{{}}}\n    \\toprule\n    {} \\\\\n    \\midrule\n",
                        kinds, titles);
    const std::vector<std::optional<double>> best = bestOf(table);
    for (const Row& row : table.rows) {
        std::string line;
        for (const std::size_t i : chosen) {
            const std::string cell = latexCell(row.cells[i], table.columns[i]);
            const bool isBest = best[i] && row.cells[i].value == best[i] && !isBaselineRow(row);
            line += (line.empty() ? "" : " & ") + (isBest ? fmt::format("\\textbf{{{}}}", cell) : cell);
        }
        text += fmt::format("    {} \\\\\n", line);
    }
    return text + "    \\bottomrule\n  \\end{tabular}}\n\\end{table}\n";
}

std::string markdownOf(const Table& table) {
    report::TextTable plain;
    for (const Column& column : table.columns) plain.titles.push_back(column.title);
    for (const Row& row : table.rows) {
        std::vector<std::string>& cells = plain.rows.emplace_back();
        for (std::size_t i = 0; i < row.cells.size(); ++i)
            cells.push_back(truncate(row.cells[i].text, table.columns[i].prose ? sentenceRoom : nameRoom));
    }
    return fmt::format("{}\n", report::markdown(plain));
}

} // namespace shadowbench::site
