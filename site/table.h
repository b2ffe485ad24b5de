// A table of a page, and the same for papers.
#pragma once

#include "report/text_table.h"
#include "site/template.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::site {

struct Column {
    std::string title = {};
    std::string hint = {}; // what it means, in a sentence
    std::string key = {};  // by which the script knows it: a metric's path, or a number that the column stands for
    std::string unit = {}; // of the values: "share" is shown in per cent
    bool number = true;
    bool brief = true;  // has its place in a paper's table, too
    bool least = false; // the least of its values is the best
    bool prose = false; // of sentences: has room for more than a name
};

struct Cell {
    std::string text = {};            // "" is shown as it is; "–" does not apply
    std::optional<double> value = {}; // what it is sorted by and drawn at; unrounded
    std::string address = {};         // what it leads to, from the site's folder
    std::string kind = {};            // of style.css: "take", "within", "h3" …
    std::string name = {};            // of a technique: what papers' tables call it; "": its text
    std::string note = {};            // what is said when one points at it
    std::string small = {};           // below its text, in small print
};

struct Row {
    std::vector<Cell> cells = {};                                // as many as columns; the first names the row
    std::vector<std::pair<std::string, std::string>> marks = {}; // attributes data-<first>="<second>"
};

struct Table {
    std::string id; // of letters and hyphens, one of its kind on a page
    std::string caption;
    std::vector<Column> columns = {};
    std::vector<Row> rows = {};
    std::string note = {}; // below it
    bool filtered = false; // with fields for family, answer and tolerance above it
    bool headed = true;    // its caption is seen; else only heard
    bool stacked = false;  // in a narrow window each row is a list, which nobody scrolls sideways; those with prose are so
    std::vector<std::pair<std::string, std::string>> scale = {}; // kinds of cells that a colour stands for, with their words
};

/// A table of text: numbers are read off their text, the first column names the rows.
Table tableOf(const report::TextTable& text, const std::string& id, const std::string& caption);

/// For the template table.html. `root` leads from the page to the site's folder ("", "../"), `files` from there to the
/// table's files without their endings ("tables/index-answers").
Data tableData(const Table& table, const std::string& root, const std::string& files);

/// RFC 4180; values unrounded where a cell has one.
std::string csvOf(const Table& table);

/// A float with booktabs and, unless `brief`, all columns, made as wide as the line (package graphicx); \label{tab:<label>},
/// and the best of each column bold: of all rows but the baselines (mark "baseline").
std::string latexOf(const Table& table, bool brief, const std::string& label);

std::string markdownOf(const Table& table);

/// Text as LaTeX shows it, with \usepackage[utf8]{inputenc} and textcomp; characters that these lack become "?".
std::string latexText(const std::string& text);

} // namespace shadowbench::site
