package io.troupe.demo;

import io.troupe.services.text.Suggestions;
import java.util.Collection;
import java.util.List;
import java.util.regex.Pattern;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.UnmatchedArgumentException;

/** Error messages for wrong arguments: one line, with a suggestion for misspelled names. */
final class UsageProblems {
    private static final String ERROR = "Error: ";
    private static final String INVALID_VALUE = "Invalid value for ";
    /** Message of picocli's help command. */
    private static final Pattern UNKNOWN_COMMAND = Pattern.compile("Unknown subcommand '(.*)'\\.?");

    private static final int FEWEST_LETTERS = 3; // shortest prefix of a name that gives a suggestion

    private UsageProblems() {}

    static String message(ParameterException wrong) {
        String line = wrong.getMessage().lines().findFirst().orElse("wrong arguments");
        if (wrong instanceof UnmatchedArgumentException unmatched) {
            return unmatched(unmatched.getUnmatched(), wrong.getCommandLine());
        }
        var unknown = UNKNOWN_COMMAND.matcher(line);
        if (unknown.matches()) {
            return unmatched(List.of(unknown.group(1)), wrong.getCommandLine());
        }
        if (line.startsWith(INVALID_VALUE)) {
            return line.substring(INVALID_VALUE.length())
                    .replaceFirst("^option '([^']*)'(?: \\([^)]*\\))?: ", "$1 is ");
        }
        return line.startsWith(ERROR) ? line.substring(ERROR.length()) : line;
    }

    private static String unmatched(List<String> arguments, CommandLine commandLine) {
        String first = arguments.getFirst();
        CommandSpec spec = commandLine.getCommandSpec();
        if (first.startsWith("-")) {
            String option = first.replaceFirst("=.*", "");
            List<String> known = spec.optionsMap().keySet().stream()
                    .filter(each -> each.startsWith("--"))
                    .toList();
            return "there is no option " + option + meant(option, known);
        }
        return spec.subcommands().isEmpty()
                ? "'" + first + "' is one argument too many"
                : "there is no command '" + first + "'"
                        + meant(first, spec.subcommands().keySet());
    }

    /** The known name closest to the one given, by edit distance or as a prefix. */
    private static String meant(String written, Collection<String> known) {
        return Suggestions.nearest(written, known)
                .or(() -> known.stream()
                        .filter(each -> written.length() >= FEWEST_LETTERS && each.startsWith(written))
                        .findFirst())
                .map(name -> "; did you mean " + name + "?")
                .orElseGet(() -> written.startsWith("-") ? "" : "; there are " + String.join(", ", known));
    }
}
