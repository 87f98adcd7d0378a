#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "force/catalogue.hpp"
#include "force/lane.hpp"
#include "script/render_command.hpp"
#include "script/specification.hpp"
#include "script/state.hpp"
#include "store/trajectory.hpp"
#include "theory/catalogue.hpp"
#include "theory/errata.hpp"

namespace {

// A script may raise an error of any length.
std::string shortened(const std::string& message) {
  constexpr std::size_t most = 20000;
  return message.size() <= most ? message
                                : message.substr(0, most) + fmt::format("... ({} bytes more)", message.size() - most);
}

using namespace ricochet;

int run(RunOptions options, const std::string& script, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument.starts_with('=') || argument.ends_with('='))
      throw Error(fmt::format("'{}': write name=value without spaces around '='", argument), Exit::usage);
  for (const std::string& argument : arguments)
    if (argument.find('=') == std::string::npos)
      throw Error(fmt::format("'{}' is neither an option nor name=value; see ricochet run --help", argument),
                  Exit::usage);
  if (options.out.empty()) throw Error("--out needs a folder", Exit::usage);
  if (options.resume && options.force)
    throw Error("--resume continues earlier results and --force replaces them; give one of them", Exit::usage);
  Session session(std::move(options), script, arguments);
  // With arguments, a misspelt one is reported first: ricochet.parameters then looks at the folder.
  if (!session.options.help && arguments.empty()) session.refuse_earlier_results(session.own_folder());
  State state(session);
  try {
    if (!session.options.study.empty()) session.options.check = true;
    state.run_script();
    if (!session.options.study.empty() && !session.done) {
      session.options.check = false;
      state.study_first_scene();
    }
    if (session.options.help && !session.done) session.print(fmt::format("{} declares no parameters.\n", script));
  } catch (const Error& error) {
    session.log(fmt::format("error: {}\n", shortened(error.what())));
    const bool keep = error.exit == Exit::script && session.something_stored();
    try {
      session.write_log();
    } catch (const FileError&) {  // the first error is the one to report
    }
    if (keep)
      throw Error(fmt::format("{}\n  what was stored stays in {}; correct the script and add --resume", error.what(),
                              session.options.out));
    throw;
  }
  session.finish();
  if (session.nothing_finished())
    throw Error("not one impact finished; the first ended " + session.first_failure, Exit::numerical);
  return 0;
}

// The user's next line; false at the end.
bool prompted(std::string& line) {
  fmt::print("> ");
  std::fflush(stdout);
  return static_cast<bool>(std::getline(std::cin, line));
}

int repl() {
  Session session({}, "repl", {});
  State state(session);
  state.run_text("rawset(_G, 'ricochet', require 'ricochet')");
  fmt::print("{}\nLua with `ricochet` loaded; end with ^D.\n", version_text().substr(0, version_text().find('\n')));
  std::string line;
  while (prompted(line)) {
    try {
      state.run_text(line);
    } catch (const Error& error) {
      fmt::print(stderr, "error: {}\n", shortened(error.what()));
    }
  }
  fmt::print("\n");
  return 0;
}

void print_effects() {
  each_effect_kind([]<class E>(const E&) {
    fmt::print("{}: {}\n  {}\n", E::name, E::doc, E::example);
    for (const auto& member : E::fields()) {
      const Field& f = member.field;
      fmt::print("    {:<12}{}{}{}\n", f.name, f.doc, f.unit.empty() ? "" : " [" + f.unit + "]",
                 f.initial.empty() ? "" : " (default " + f.initial + ")");
    }
    if (E::energy_doc) fmt::print("  column {}_energy: {}\n", E::name, E::energy_doc);
    if constexpr (SpringChange<E>) fmt::print("  column {}_springs: {}\n", E::name, E::count_doc);
    fmt::print("\n");
  });
  fmt::print(
      "What a scene does not name in `effects = {{ ... }}` is not computed; ricochet effects --cost measures what each "
      "costs.\n");
}

// Lines of at most `width` bytes, each after `indent`.
std::string wrapped(const std::string& text, const std::string& indent, std::size_t width = 120) {
  std::string result, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > width) {
      result += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + indent + line + "\n";
}

// All, or the one of that name.
void print_theories(const std::string& name) {
  std::vector<std::string> known;
  for (const theory::Theory& t : theory::theories()) {
    known.push_back(t.name);
    if (!name.empty() && t.name != name) continue;
    std::string names;
    for (const Field& f : t.arguments) names += (names.empty() ? "" : ", ") + f.name;
    fmt::print("{} {{ {} }}\n{}{}{}", t.name, names, wrapped(t.says, "  "), wrapped("valid: " + t.valid, "  "),
               wrapped("source: " + t.source, "  "));
  }
  if (!name.empty() && std::find(known.begin(), known.end(), name) == known.end()) {
    known.push_back("errata");
    throw Error(
        fmt::format(
            "there is no theory '{}'{}; ricochet theory lists them, ricochet theory errata the paper's misprints", name,
            did_you_mean(name, known)),
        Exit::usage);
  }
  fmt::print(
      "\nAs ricochet.theory.NAME {{ field = value, ... }} in a script; fields, units and results in lua/REFERENCE.md, "
      "sources in src/theory/references.bib.\n"
      "Misprints of the paper: ricochet theory errata\n");
}

void print_errata() {
  int number = 0;
  for (const theory::Misprint& m : theory::errata())
    fmt::print("{}. {}\n{}{}{}\n", ++number, m.where, wrapped(std::string("printed: ") + m.printed, "   "),
               wrapped(std::string("right:   ") + m.right, "   "),
               wrapped(std::string("checked: ") + m.checked, "   "));
}

int info(const std::string& path) {
  const Provenance provenance = read_provenance(path);
  for (const auto& [name, text] : provenance)
    if (name != "script" && !text.empty()) fmt::print("{:<14} {}\n", name, text.substr(0, text.find('\n')));
  if (is_trajectory(path)) {
    fmt::print("a trajectory (H5MD)\n");
    return 0;
  }
  const Table table = read_table(path);
  fmt::print("{} rows\n", table.rows());
  if (const TextColumn* status = table.text("status")) {
    std::map<std::string, int> counts;
    for (const std::string& value : status->values) ++counts[value];
    for (const auto& [value, count] : counts) fmt::print("  {:<14} {}\n", value, count);
  }
  for (const TextColumn& column : table.texts) fmt::print("  {:<28} {}\n", column.field.name, column.field.doc);
  for (const NumberColumn& column : table.numbers)
    fmt::print(
        "  {:<28} {}\n",
        column.field.unit.empty() ? column.field.name : fmt::format("{} [{}]", column.field.name, column.field.unit),
        column.field.doc);
  return 0;
}

int program(int count, char** words) {
  CLI::App app("A workbench for the impact of elastic bodies, driven by Lua scripts.", "ricochet");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);
  RunOptions options;
  std::string script, file;
  std::vector<std::string> arguments;

  CLI::App* run_command = app.add_subcommand("run", "Run a script: ricochet run SCRIPT [name=value ...]");
  run_command->set_help_flag();  // --help after the script is the script's own
  run_command->add_option("SCRIPT", script, "the Lua script");
  run_command->add_option("name=value", arguments, "the script's parameters");
  run_command->add_option("--threads", options.threads, "worker threads; all cores unless given")
      ->check(CLI::Range(1, 1024));
  run_command
      ->add_option("--batch", options.batch,
                   fmt::format("impacts that advance together, 1 to {}; never changes a result", lanes))
      ->check(CLI::Range(1, lanes));
  run_command->add_option("--out", options.out, "folder of the results (default: out)");
  run_command
      ->add_option(
          "--budget", options.budget,
          "greatest work of the script, in Lua instructions; long strings, searches and files count as what they cost")
      ->check(CLI::Range(1LL, 1000000000000000LL));
  run_command->add_flag("--resume", options.resume, "go on with earlier results");
  run_command->add_flag("--force", options.force, "replace earlier results");
  run_command->add_flag("--check", options.check, "build every scene, run none");
  run_command->add_flag("--traceback", options.traceback, "show where in the scripts an error came from");
  run_command->add_flag("--quiet", options.quiet, "no progress");
  run_command->add_flag("--unsafe", options.unsafe, "lift the sandbox: io, os.execute, debug");
  run_command->add_flag("--help,-h", options.help, "this, or the script's own parameters");
  CLI::App* accuracy_command = app.add_subcommand(
      "accuracy", "What accuracy costs in a script's first scene: ricochet accuracy SCRIPT [name=value ...]");
  accuracy_command->add_option("SCRIPT", script, "the Lua script")->required();
  accuracy_command->add_option("name=value", arguments, "the script's parameters");
  accuracy_command->add_option("--out", options.out, "folder of the results (default: out)");
  accuracy_command->add_flag("--force", options.force, "replace earlier results");
  bool price = false;
  CLI::App* effects_command = app.add_subcommand(
      "effects",
      "The effects that a scene may name, and what they cost: ricochet effects [--cost [SCRIPT [name=value ...]]]");
  effects_command->add_flag("--cost", price,
                            "measure what each costs, in the script's first scene or the paper's soft wall");
  effects_command->add_option("SCRIPT", script, "the Lua script");
  effects_command->add_option("name=value", arguments, "the script's parameters");
  effects_command->add_option("--out", options.out, "folder of the results (default: out)");
  CLI::App* theory_command = app.add_subcommand(
      "theory",
      "The theories that a script may call, with where they hold; ricochet theory errata: the paper's misprints");
  std::string theory_name;
  theory_command->add_option("NAME", theory_name,
                             "one of them; or errata: misprints, what is printed, what is right, how it was checked");
  CLI::App* repl_command = app.add_subcommand("repl", "Type Lua");
  CLI::App* info_command = app.add_subcommand("info", "What a results.h5 holds and where it came from");
  info_command->add_option("FILE", file, "an HDF5 file of ours")->required();
  RenderOptions drawing;
  CLI::App* render_command = app.add_subcommand(
      "render", "Draw a recorded impact: ricochet render FILE.h5 [name=value ...], with the names of the show table");
  render_command->add_option("FILE", drawing.file, "an HDF5 file of ricochet.record")->required();
  render_command->add_option("name=value", drawing.settings,
                             "what the pictures show: material=speed ledger=true ...; see show in ricochet reference");
  render_command->add_option("--size", drawing.size, "width and height in pixels (default: 1280x720)");
  render_command->add_option("--out", drawing.out,
                             "folder of the frames (default: FILE_frames, unless only a film is asked for)");
  render_command->add_option("--film", drawing.film, "an .mp4 file; needs ffmpeg");
  render_command->add_option("--rate", drawing.rate, "frames a second of the film (default: 30)")
      ->check(CLI::Range(1.0, 240.0));
  render_command->add_option("--threads", drawing.threads, "threads that encode; all cores unless given")
      ->check(CLI::Range(1, 1024));
  render_command->add_flag("--resume", drawing.resume, "keep the frames that are drawn already");
  render_command->add_flag("--force", drawing.force, "replace what is there");
  render_command->add_flag("--quiet", drawing.quiet, "print nothing");
  bool stubs = false;
  CLI::App* reference_command = app.add_subcommand("reference", "Print the reference of the Lua module");
  reference_command->add_flag("--stubs", stubs, "as definitions for the Lua language server");

  try {
    app.parse(count, words);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return 0;
  } catch (const CLI::CallForVersion&) {
    std::cout << version_text() << '\n';
    return 0;
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> commands{"run",  "accuracy", "effects", "theory",
                                            "repl", "info",     "render",  "reference"};
    std::string hint;
    const std::vector<std::string> options_known{"--threads", "--batch",  "--out",   "--budget",
                                                 "--resume",  "--force",  "--check", "--traceback",
                                                 "--quiet",   "--unsafe", "--help"};
    for (int i = 1; i < count && *run_command; ++i) {
      const std::string word = words[i];
      if (!word.starts_with("--") || std::find(options_known.begin(), options_known.end(), word) != options_known.end())
        continue;
      hint = word.find('=') != std::string::npos
                 ? fmt::format(" (a parameter of the script is written {}, without dashes)", word.substr(2))
                 : did_you_mean(word, options_known);
    }
    if (count > 1 && std::string(words[1]).ends_with(".lua"))
      hint = fmt::format(" (did you mean: ricochet run {}?)", words[1]);
    else if (count > 1 && std::find(commands.begin(), commands.end(), words[1]) == commands.end())
      hint = did_you_mean(words[1], commands);
    throw Error(fmt::format("{}{}; see ricochet --help", error.what(), hint), Exit::usage);
  }
  if (*run_command) {
    if (script.empty()) {
      if (!options.help) throw Error("run needs a script: ricochet run SCRIPT [name=value ...]", Exit::usage);
      std::cout << run_command->help();
      return 0;
    }
    return run(options, script, arguments);
  }
  if (*accuracy_command) {
    options.study = "require('ricochet').accuracy { scene = first_scene }";
    return run(options, script, arguments);
  }
  if (*effects_command) {
    if (!price) {
      if (!script.empty())
        throw Error(
            fmt::format(
                "effects lists them all and takes no '{}'; to price those of a script: ricochet effects --cost SCRIPT",
                script),
            Exit::usage);
      print_effects();
      return 0;
    }
    options.study = "require('ricochet.effects').cost(first_scene, 5)";
    if (!script.empty()) return run(options, script, arguments);
    Session session({}, "effects", {});
    State(session).run_text("require('ricochet.effects').cost(nil, 5)");
    return 0;
  }
  if (*theory_command) {
    theory_name == "errata" ? print_errata() : print_theories(theory_name);
    return 0;
  }
  if (*repl_command) return repl();
  if (*info_command) return info(file);
  if (*render_command) {
    if (drawing.resume && drawing.force)
      throw Error("--resume keeps earlier frames and --force replaces them; give one of them", Exit::usage);
    render_file(drawing);
    return 0;
  }
  if (*reference_command) std::cout << (stubs ? editor_stubs() : reference_page());
  return 0;
}

}  // namespace

int main(int count, char** words) {
  catch_signals();
  try {
    return program(count, words);
  } catch (const Error& error) {
    const std::string message = error.what();
    fmt::print(stderr, "error: {}\n", shortened(message.substr(0, message.find_last_not_of('\n') + 1)));
    return static_cast<int>(error.exit);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {} (this is a mistake of the program; please report it)\n", error.what());
    return static_cast<int>(Exit::script);
  }
}
