#include "config/yaml_config.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "config/value_text.hpp"
#include "core/error.hpp"

namespace credo {
namespace {

/// Number of single edits from one word to another (Levenshtein 1966).
std::size_t edit_distance(std::string const& a, std::string const& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const substituted = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

/// " (did you mean smoothing_px?)" where a known key is close, else nothing.
std::string suggestion(std::string const& key, FieldList const& fields) {
  std::string best;
  std::size_t least = key.size() / 3 + 2;
  for (Field const& field : fields) {
    std::size_t const distance = edit_distance(key, field.name);
    if (distance < least) {
      least = distance;
      best = field.name;
    }
  }
  return best.empty() ? "" : " (did you mean " + best + "?)";
}

/// "a list of 3 numbers", "a list of 1 to 5 numbers", "one number or a list of 3".
std::string count_text(NumbersTarget const& target) {
  std::string const most = std::to_string(target.max_count);
  if (target.one_for_all) {
    return "one number or a list of " + most;
  }
  if (target.min_count == target.max_count) {
    return "a list of " + most + " numbers";
  }
  bool const bounded = target.max_count != std::numeric_limits<std::size_t>::max();
  std::string const least = std::to_string(target.min_count);
  return "a list of " + (bounded ? least + " to " + most : "at least " + least) + " numbers";
}

/// What a value written in this form goes to.
Field in_form(Field const& field, OneOfTarget const& one_of, Form form) {
  Field result = field;
  switch (form) {
    case Form::kWord:
      result.target = one_of.word;
      break;
    case Form::kMap:
      result.target = one_of.map;
      break;
    case Form::kList:
      result.target = one_of.list;
      break;
  }
  return result;
}

Form form_of(YAML::Node const& value) {
  return value.IsMap() ? Form::kMap : value.IsSequence() ? Form::kList : Form::kWord;
}

/// Walks a YAML tree beside a field list and collects what does not fit.
class Loader {
public:
  explicit Loader(std::string origin, bool has_lines)
      : origin_(std::move(origin)), has_lines_(has_lines) {}

  void apply(FieldList const& fields, YAML::Node const& node, std::string const& prefix) {
    if (node.IsNull()) {
      return;
    }
    if (!node.IsMap()) {
      add(node, (prefix.empty() ? "the file" : prefix) + ": must be a map of keys");
      return;
    }
    std::set<std::string> seen;
    for (auto const& pair : node) {
      auto const key = pair.first.IsScalar() ? pair.first.Scalar() : std::string("?");
      std::string const path = prefix.empty() ? key : prefix + "." + key;
      auto const field = std::find_if(fields.begin(), fields.end(),
                                      [&key](Field const& f) { return f.name == key; });
      if (field == fields.end()) {
        add(pair.first, "unknown key " + path + suggestion(key, fields));
      } else if (!seen.insert(key).second) {
        add(pair.first, "duplicate key " + path);
      } else {
        apply_field(*field, pair.first, pair.second, path);
      }
    }
  }

  std::vector<std::string> errors;

private:
  void apply_field(Field const& field, YAML::Node const& key, YAML::Node const& value,
                   std::string const& path) {
    if (auto const* members = std::get_if<FieldList>(&field.target)) {
      apply(*members, value, path);
    } else if (auto const* numbers = std::get_if<NumbersTarget>(&field.target)) {
      apply_numbers(field, *numbers, key, value, path);
    } else if (auto const* list = std::get_if<ListTarget>(&field.target)) {
      apply_list(*list, key, value, path);
    } else if (auto const* one_of = std::get_if<std::shared_ptr<OneOfTarget>>(&field.target)) {
      *(*one_of)->form = form_of(value);
      apply_field(in_form(field, **one_of, form_of(value)), key, value, path);
    } else if (!value.IsScalar()) {
      add(key, path + ": must be a single value");
    } else {
      std::string const error = set_from_text(field, value.Scalar());
      if (!error.empty()) {
        add(key, path + " = " + value.Scalar() + ": " + error);
      }
    }
  }

  void apply_list(ListTarget const& list, YAML::Node const& key, YAML::Node const& value,
                  std::string const& path) {
    if (!value.IsSequence()) {
      add(key, path + ": must be a list");
      return;
    }
    list.clear();
    for (std::size_t i = 0; i < value.size(); ++i) {
      FieldList const item = list.append();
      std::string const item_path = path + "[" + std::to_string(i) + "]";
      // What has one member may be written without its name.
      if (item.size() == 1 && value[i].IsSequence()) {
        apply_field(item.front(), value[i], value[i], item_path);
      } else {
        apply(item, value[i], item_path);
      }
    }
  }

  void apply_numbers(Field const& field, NumbersTarget const& target, YAML::Node const& key,
                     YAML::Node const& value, std::string const& path) {
    std::vector<double> numbers;
    bool const one_for_all = target.one_for_all && value.IsScalar();
    std::size_t const written = one_for_all ? 1 : value.IsSequence() ? value.size() : 0;
    for (std::size_t i = 0; i < written; ++i) {
      YAML::Node const& node = one_for_all ? value : value[i];
      double number = 0.0;
      Field const element{field.name, &number, field.range, field.unit, field.text};
      std::string const text = node.IsScalar() ? node.Scalar() : "?";
      std::string const error = set_from_text(element, text);
      if (!error.empty()) {
        std::string const place = one_for_all ? "" : "[" + std::to_string(i) + "]";
        add(key, path + place + " = " + text + ": " + error);
        return;
      }
      numbers.push_back(number);
    }
    if (one_for_all) {
      numbers.resize(target.max_count, numbers.front());
    }
    bool const is_list = one_for_all || value.IsSequence();
    if (!is_list || numbers.size() < target.min_count || numbers.size() > target.max_count) {
      add(key, path + ": must be " + count_text(target));
      return;
    }
    *target.values = std::move(numbers);
  }

  void add(YAML::Node const& node, std::string const& what) {
    YAML::Mark const mark = node.Mark();
    std::string where = origin_;
    if (has_lines_ && !mark.is_null()) {
      where += ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
    }
    errors.push_back(where + ": " + what);
  }

  std::string origin_;
  bool has_lines_;
};

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<std::string> load_file(FieldList const& fields, std::filesystem::path const& path) {
  // Opened as a stream, a folder reads like an empty file.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return {path.string() + ": is a folder, not a config file"};
  }
  try {
    std::vector<YAML::Node> const documents = YAML::LoadAllFromFile(path.string());
    if (documents.size() > 1) {
      return {path.string() + ": must be one YAML document, not " +
              std::to_string(documents.size())};
    }
    Loader loader(path.string(), true);
    if (!documents.empty()) {
      loader.apply(fields, documents.front(), "");
    }
    return std::move(loader.errors);
  } catch (YAML::BadFile const&) {
    return {path.string() + ": cannot be read"};
  } catch (YAML::Exception const& error) {
    return {path.string() + ":" + std::to_string(error.mark.line + 1) + ":" +
            std::to_string(error.mark.column + 1) + ": not YAML: " + error.msg};
  }
}

std::vector<std::string> load_override(FieldList const& fields, std::string const& text) {
  std::size_t const equals = text.find('=');
  // Dots stand between keys only.
  std::string const between = "." + text.substr(0, equals) + ".";
  if (equals == std::string::npos || between.find("..") != std::string::npos) {
    return {"--set " + text + ": must be key.path=value"};
  }
  try {
    // a.b=c is the map {a: {b: c}}.
    YAML::Node value = YAML::Load(text.substr(equals + 1));
    std::string path = text.substr(0, equals);
    while (!path.empty()) {
      std::size_t const dot = path.rfind('.');
      YAML::Node outer;
      outer[dot == std::string::npos ? path : path.substr(dot + 1)] = value;
      value.reset(outer);
      path = dot == std::string::npos ? "" : path.substr(0, dot);
    }
    Loader loader("--set " + text, false);
    loader.apply(fields, value, "");
    return std::move(loader.errors);
  } catch (YAML::Exception const& error) {
    return {"--set " + text + ": not YAML: " + error.msg};
  }
}

std::string comment_of(Field const& field) {
  std::string comment = field.text;
  std::string const range = range_text(field.range);
  if (!field.unit.empty() || !range.empty()) {
    comment += " (" + range + (range.empty() || field.unit.empty() ? "" : " ") + field.unit + ")";
  }
  if (auto const* choice = std::get_if<ChoiceTarget>(&field.target)) {
    comment += " (" + words_text(*choice) + ")";
  }
  return comment;
}

/// Empty or 0 where that may not be written: the value was not given.
bool is_absent(Field const& field) {
  if (auto const* number = std::get_if<double*>(&field.target)) {
    return **number == 0.0 && !check_range(field, 0.0).empty();
  }
  auto const* numbers = std::get_if<NumbersTarget>(&field.target);
  return numbers != nullptr && numbers->values->size() < numbers->min_count;
}

void print_yaml(FieldList const& fields, std::string const& indent, std::string& out) {
  for (Field const& field : fields) {
    if (is_absent(field)) {
      continue;
    }
    if (auto const* members = std::get_if<FieldList>(&field.target)) {
      out += indent + "# " + field.text + "\n" + indent + field.name + ":\n";
      print_yaml(*members, indent + "  ", out);
    } else if (auto const* list = std::get_if<ListTarget>(&field.target)) {
      std::vector<FieldList> const items = list->items();
      out += indent + "# " + field.text + "\n" + indent + field.name + ":" +
             (items.empty() ? " []\n" : "\n");
      for (FieldList const& item : items) {
        out += indent + "  -\n";
        print_yaml(item, indent + "    ", out);
      }
    } else if (auto const* one_of = std::get_if<std::shared_ptr<OneOfTarget>>(&field.target)) {
      print_yaml({in_form(field, **one_of, *(*one_of)->form)}, indent, out);
    } else {
      out += indent + field.name + ": " + value_text(field) + "  # " + comment_of(field) + "\n";
    }
  }
}

/// What a value may be: the range of a number, the words of a choice.
std::string allowed_text(Field const& field) {
  auto const* choice = std::get_if<ChoiceTarget>(&field.target);
  return choice != nullptr ? words_text(*choice) : range_text(field.range);
}

/// A bar would end a table's cell.
std::string cell(std::string const& text) {
  std::string result;
  for (char const c : text) {
    result += c == '|' ? "\\|" : std::string(1, c);
  }
  return result;
}

void print_rows(FieldList const& fields, std::string const& prefix, std::string& out) {
  for (Field const& field : fields) {
    if (auto const* members = std::get_if<FieldList>(&field.target)) {
      print_rows(*members, prefix + field.name + ".", out);
    } else if (!std::holds_alternative<ListTarget>(field.target)) {
      out += "| `" + prefix + field.name + "` | `" + cell(value_text(field)) + "` | " + field.unit +
             " | " + allowed_text(field) + " | " + cell(field.text) + " |\n";
    }
  }
}

std::string table_of(FieldList const& fields, std::string const& prefix) {
  std::string rows;
  print_rows(fields, prefix, rows);
  return rows.empty() ? ""
                      : "| key | default | unit | allowed | what |\n|---|---|---|---|---|\n" + rows;
}

}  // namespace

void load_config(FieldList const& fields, std::vector<std::filesystem::path> const& files,
                 std::vector<std::string> const& overrides) {
  std::vector<std::string> errors;
  for (auto const& file : files) {
    append(errors, load_file(fields, file));
  }
  for (auto const& text : overrides) {
    append(errors, load_override(fields, text));
  }
  if (!errors.empty()) {
    std::string all;
    for (std::string const& error : errors) {
      all += (all.empty() ? "" : "\n") + error;
    }
    throw InputError(all);
  }
}

std::string config_yaml(FieldList const& fields) {
  std::string out;
  print_yaml(fields, "", out);
  return out;
}

std::string config_markdown(FieldList const& fields) {
  FieldList alone;
  std::string out;
  for (Field const& field : fields) {
    if (auto const* members = std::get_if<FieldList>(&field.target)) {
      out += "\n## " + field.name + "\n\n" + field.text + "\n\n" +
             table_of(*members, field.name + ".");
    } else {
      alone.push_back(field);
    }
  }
  return table_of(alone, "") + out;
}

}  // namespace credo
