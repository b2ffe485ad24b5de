#include "tools/mutants/operators/syntax.h"

#include "base/error.h"
#include "tools/mutants/operators/operations.h"

#include <algorithm>
#include <cctype>
#include <clang-c/CXCompilationDatabase.h>
#include <clang-c/Index.h>
#include <fmt/format.h>
#include <memory>

namespace shadowbench::mutants {
namespace {

constexpr const char* fileName = "mutated.cpp"; // the source is in memory only

std::string text(CXString string) {
    const char* characters = clang_getCString(string);
    std::string result = characters == nullptr ? "" : characters;
    clang_disposeString(string);
    return result;
}

struct Disposer {
    void operator()(CXTranslationUnitImpl* unit) const { clang_disposeTranslationUnit(unit); }
};

class Unit {
public:
    Unit(const std::string& source, const std::vector<std::string>& flags)
        : index_(clang_createIndex(0, 0), &clang_disposeIndex) {
        std::vector<const char*> words{"-w", "-Wno-narrowing", "-xc++"};
        for (const std::string& flag : flags) words.push_back(flag.c_str());
        CXUnsavedFile file{fileName, source.data(), source.size()};
        unit_.reset(clang_parseTranslationUnit(index_.get(), fileName, words.data(), static_cast<int>(words.size()), &file,
                                               1, CXTranslationUnit_KeepGoing));
        if (!unit_) throw InternalError("libclang cannot read a source");
    }

    [[nodiscard]] CXCursor root() const { return clang_getTranslationUnitCursor(unit_.get()); }

    /// Offsets into the source of errors and of the notes on them.
    [[nodiscard]] std::vector<std::size_t> errors() const {
        std::vector<std::size_t> offsets;
        for (unsigned i = 0; i < clang_getNumDiagnostics(unit_.get()); ++i) {
            CXDiagnostic error = clang_getDiagnostic(unit_.get(), i);
            if (clang_getDiagnosticSeverity(error) >= CXDiagnostic_Error) {
                addOffset(error, offsets);
                CXDiagnosticSet notes = clang_getChildDiagnostics(error);
                for (unsigned n = 0; n < clang_getNumDiagnosticsInSet(notes); ++n)
                    addOffset(clang_getDiagnosticInSet(notes, n), offsets);
            }
            clang_disposeDiagnostic(error);
        }
        return offsets;
    }

private:
    static void addOffset(CXDiagnostic diagnostic, std::vector<std::size_t>& offsets) {
        CXSourceLocation location = clang_getDiagnosticLocation(diagnostic);
        unsigned offset = 0;
        clang_getExpansionLocation(location, nullptr, nullptr, nullptr, &offset);
        if (clang_Location_isFromMainFile(location) != 0) offsets.push_back(offset);
    }

    std::unique_ptr<void, decltype(&clang_disposeIndex)> index_;
    std::unique_ptr<CXTranslationUnitImpl, Disposer> unit_;
};

/// The expression or declaration at a cursor.
struct Node {
    CXCursor cursor;
    std::size_t begin, end;

    explicit Node(CXCursor at) : cursor(at) {
        const CXSourceRange range = clang_getCursorExtent(at);
        unsigned first = 0, last = 0;
        clang_getExpansionLocation(clang_getRangeStart(range), nullptr, nullptr, nullptr, &first);
        clang_getExpansionLocation(clang_getRangeEnd(range), nullptr, nullptr, nullptr, &last);
        begin = first;
        end = last;
    }

    [[nodiscard]] CXCursorKind kind() const { return clang_getCursorKind(cursor); }
    [[nodiscard]] CXType type() const { return clang_getCanonicalType(clang_getCursorType(cursor)); }
    [[nodiscard]] std::size_t place() const { // of the name of a declaration
        unsigned offset = 0;
        clang_getExpansionLocation(clang_getCursorLocation(cursor), nullptr, nullptr, nullptr, &offset);
        return offset;
    }
    [[nodiscard]] std::vector<Node> children() const {
        std::vector<Node> result;
        clang_visitChildren(
            cursor,
            [](CXCursor child, CXCursor, CXClientData data) {
                static_cast<std::vector<Node>*>(data)->emplace_back(child);
                return CXChildVisit_Continue;
            },
            &result);
        return result;
    }
};

class Finder {
public:
    explicit Finder(const std::string& source) : source_(source) {}

    void findIn(const Node& node) {
        switch (node.kind()) {
        case CXCursor_BinaryOperator:
        case CXCursor_CompoundAssignOperator:
            findInBinary(node, node.children());
            break;
        case CXCursor_UnaryOperator:
            findInUnary(node);
            break;
        case CXCursor_CallExpr:
            findInCall(node);
            break;
        case CXCursor_ConditionalOperator:
            findInChoice(node, node.children());
            break;
        case CXCursor_IntegerLiteral:
        case CXCursor_FloatingLiteral:
        case CXCursor_CXXBoolLiteralExpr:
            if (std::isalnum(source_[node.begin]) != 0) // a comparison made of <=> has a 0 of its own
                add(node, changesOfLiteral(written(node), values(node)));
            break;
        case CXCursor_IfStmt:
            findInCondition(node.children());
            break;
        case CXCursor_VarDecl:
            placeOfName_ = node.place();
            break;
        default:
            break;
        }
        for (const Node& part : statementsOf(node)) findStatement(part);
        for (const Node& part : evaluatedPartsOf(node)) findIn(part);
    }

    std::vector<Point> points; // found so far

private:
    [[nodiscard]] std::string written(std::size_t begin, std::size_t end) const {
        return source_.substr(begin, end - begin);
    }
    [[nodiscard]] std::string written(const Node& node) const { return written(node.begin, node.end); }

    static Values values(const Node& node) {
        const CXTypeKind kind = referred(node.type()).kind;
        if (kind == CXType_Float || kind == CXType_Double || kind == CXType_LongDouble) return Values::Floating;
        if (kind >= CXType_Bool && kind <= CXType_UInt128) return Values::Unsigned;
        if (kind >= CXType_Char_S && kind <= CXType_Int128) return Values::Signed;
        return typeName(node).starts_with("glm::") ? Values::Vector : Values::Other;
    }

    static CXType referred(CXType type) {
        const bool isReference = type.kind == CXType_LValueReference || type.kind == CXType_RValueReference;
        return isReference ? clang_getPointeeType(type) : type;
    }

    static std::string typeName(const Node& node) {
        const std::string name = text(clang_getTypeSpelling(referred(node.type())));
        return name.starts_with("const ") ? name.substr(6) : name;
    }

    static std::string spelling(const Node& node) { return text(clang_getCursorSpelling(node.cursor)); }

    static bool alike(const Node& a, const Node& b) { return typeName(a) == typeName(b); }

    void add(const Node& node, const std::vector<Change>& changes) {
        for (const Change& change : changes) points.push_back({node.begin, node.end, change.operation, change.after, 0});
    }

    void findInBinary(const Node& node, const std::vector<Node>& operands) {
        if (operands.size() != 2 || operands[0].end > operands[1].begin) return;
        std::string sign = written(operands[0].end, operands[1].begin);
        std::erase_if(sign, [](char c) { return c == ' ' || c == '\n'; });
        const bool isAlike = alike(node, operands[0]) || values(node) < Values::Vector;
        std::vector<Change> changes =
            changesOfBinary(written(operands[0]), sign, written(operands[1]), values(node), isAlike);
        if (node.begin == beginOfSize_)
            std::erase_if(changes, [&](const Change& change) {
                return change.operation == "swapped operands" || change.after == fmt::format("std::abs({})", written(node));
            });
        add(node, changes);
    }

    void findInUnary(const Node& node) {
        const std::string operand = written(node.begin + 1, node.end);
        if (source_[node.begin] == '!' && source_[node.begin + 1] != '=') // != may be made of ==
            add(node, {{"negated condition", fmt::format("static_cast<bool>({})", operand)}});
        if (source_[node.begin] == '-' && source_[node.begin + 1] != '-') add(node, {{"other sign", operand}});
    }

    void findInChoice(const Node& node, const std::vector<Node>& parts) {
        if (parts.size() != 3) return;
        const std::string swapped = fmt::format("{} ? {} : {}", written(parts[0]), written(parts[2]), written(parts[1]));
        add(node, {{"swapped operands", swapped}});
        findInCondition(parts);
    }

    /// The first of `parts` is a condition; those that compare or join others have changes of their own.
    void findInCondition(const std::vector<Node>& parts) {
        if (parts.empty()) return;
        Node inner = parts.front();
        while (inner.kind() == CXCursor_UnexposedExpr && inner.children().size() == 1) inner = inner.children().front();
        const bool isPlain = inner.kind() == CXCursor_CallExpr || inner.kind() == CXCursor_DeclRefExpr ||
                             inner.kind() == CXCursor_MemberRefExpr;
        if (spelling(inner).starts_with("operator")) return;
        if (isPlain && typeName(inner) == "bool" && inner.begin == parts.front().begin && inner.end == parts.front().end)
            add(inner, {{"negated condition", fmt::format("!({})", written(inner))}});
    }

    void findInCall(const Node& node) {
        std::vector<Node> arguments;
        for (int i = 0; i < clang_Cursor_getNumArguments(node.cursor); ++i)
            arguments.emplace_back(clang_Cursor_getArgument(node.cursor, static_cast<unsigned>(i)));
        std::erase_if(arguments,
                      [&](const Node& a) { return a.begin < node.begin || a.end >= node.end || a.end <= a.begin; });
        if (spelling(node).starts_with("operator")) {
            arguments.clear();
            for (const Node& child : node.children())
                if (child.end > child.begin && !isOperatorsName(child)) arguments.push_back(child);
            return findInBinary(node, arguments);
        }
        if (arguments.empty() || source_[node.end - 1] != ')' || node.begin == placeOfName_) return;
        const std::string function = written(node.begin, arguments.front().begin);
        if (function.find('(') != function.size() - 1) return; // a call of a call's result, or with words between
        if (function.ends_with("abs(")) beginOfSize_ = arguments.front().begin;
        std::vector<std::string> words;
        std::vector<bool> swaps;
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            words.push_back(written(arguments[i]));
            swaps.push_back(i + 1 < arguments.size() && alike(arguments[i], arguments[i + 1]));
        }
        add(node, changesOfCall(function.substr(0, function.size() - 1), words, swaps, values(node),
                                alike(node, arguments.front())));
    }

    [[nodiscard]] bool isOperatorsName(const Node& node) const {
        return node.kind() == CXCursor_UnexposedExpr && spelling(node).starts_with("operator") &&
               written(node).find_first_not_of("+-*/%<>=!&|") == std::string::npos;
    }

    /// The children that stand as a statement of their own.
    static std::vector<Node> statementsOf(const Node& node) {
        std::vector<Node> parts = node.children();
        switch (node.kind()) {
        case CXCursor_CompoundStmt: // without the last word of a function
            std::erase_if(parts, [](const Node& part) { return leaves(part); });
            return parts;
        case CXCursor_IfStmt:
            parts.erase(parts.begin());
            return parts;
        case CXCursor_ForStmt:
        case CXCursor_WhileStmt:
        case CXCursor_CXXForRangeStmt:
            return {parts.back()};
        default:
            return {};
        }
    }

    static bool leaves(const Node& node) {
        return node.kind() == CXCursor_ReturnStmt || node.kind() == CXCursor_CXXThrowExpr ||
               (node.kind() == CXCursor_UnexposedExpr && node.children().size() == 1 && leaves(node.children().front()));
    }

    /// Where the semicolon after it ends; 0 if none comes.
    [[nodiscard]] std::size_t endOfStatement(const Node& node) const {
        const std::size_t at = source_.find_first_not_of(" \n", node.end);
        return at != std::string::npos && source_[at] == ';' && node.end > node.begin ? at + 1 : 0;
    }

    void findStatement(const Node& node) {
        switch (node.kind()) {
        case CXCursor_CallExpr:
        case CXCursor_BinaryOperator:
        case CXCursor_CompoundAssignOperator:
        case CXCursor_UnaryOperator:
        case CXCursor_ContinueStmt:
        case CXCursor_BreakStmt:
        case CXCursor_CXXThrowExpr:
        case CXCursor_ReturnStmt:
        case CXCursor_UnexposedExpr:
            break;
        default:
            return;
        }
        if (const std::size_t end = endOfStatement(node); end > 0)
            points.push_back({node.begin, end, "dropped statement", "", 0});
    }

    /// The children but for those that the compiler evaluates.
    [[nodiscard]] std::vector<Node> evaluatedPartsOf(const Node& node) const {
        std::vector<Node> parts = node.children();
        switch (node.kind()) {
        case CXCursor_StaticAssert:
        case CXCursor_EnumDecl:
        case CXCursor_DeclRefExpr:
        case CXCursor_TypeRef:
        case CXCursor_TemplateRef:
            return {};
        case CXCursor_FunctionDecl:
        case CXCursor_CXXMethod:
        case CXCursor_FunctionTemplate:
        case CXCursor_VarDecl:
        case CXCursor_FieldDecl:
        case CXCursor_ParmDecl:
            if (written(node.begin, node.place()).find("constexpr") != std::string::npos) return {};
            std::erase_if(parts, [&](const Node& part) { return part.begin < node.place(); });
            return parts;
        case CXCursor_CaseStmt:
            parts.erase(parts.begin());
            return parts;
        case CXCursor_IfStmt:
            if (written(node).starts_with("if constexpr")) parts.erase(parts.begin());
            return parts;
        default:
            return parts;
        }
    }

    const std::string& source_;
    std::size_t placeOfName_ = std::string::npos; // of the last variable, where the call of its constructor begins as well
    std::size_t beginOfSize_ = std::string::npos; // of the last difference that only matters by its absolute value
};

} // namespace

std::vector<std::string> syntaxFlags(const std::filesystem::path& build, const std::filesystem::path& file) {
    const std::unique_ptr<void, decltype(&clang_CompilationDatabase_dispose)> database(
        clang_CompilationDatabase_fromDirectory(build.c_str(), nullptr), &clang_CompilationDatabase_dispose);
    const std::unique_ptr<void, decltype(&clang_CompileCommands_dispose)> commands(
        database ? clang_CompilationDatabase_getCompileCommands(database.get(), file.c_str()) : nullptr,
        &clang_CompileCommands_dispose);
    if (!commands || clang_CompileCommands_getSize(commands.get()) == 0)
        throw InternalError(fmt::format("{} does not say how {} is compiled", build.string(), file.string()));
    CXCompileCommand command = clang_CompileCommands_getCommand(commands.get(), 0);
    std::vector<std::string> flags;
    for (unsigned i = 0; i < clang_CompileCommand_getNumArgs(command); ++i) {
        const std::string word = text(clang_CompileCommand_getArg(command, i));
        if (word == "-isystem") {
            flags.insert(flags.end(), {word, text(clang_CompileCommand_getArg(command, ++i))});
        } else if (word.starts_with("-I") || word.starts_with("-D") || word.starts_with("-std")) {
            flags.push_back(word);
        }
    }
    return flags;
}

std::vector<Point> pointsOf(const std::string& source, const std::vector<std::string>& flags) {
    const Unit unit(source, flags);
    Finder finder(source);
    for (const Node& node : Node(unit.root()).children())
        if (clang_Location_isFromMainFile(clang_getCursorLocation(node.cursor)) != 0) finder.findIn(node);
    return std::move(finder.points);
}

std::vector<std::size_t> errorsOf(const std::string& source, const std::vector<std::string>& flags) {
    return Unit(source, flags).errors();
}

} // namespace shadowbench::mutants
