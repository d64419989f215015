package io.troupe.petri.bip;

import static java.util.Objects.requireNonNull;

import java.util.Set;
import java.util.regex.Pattern;

/** The names that the BIP language allows. */
final class Names {
    private static final Pattern NAME = Pattern.compile("[A-Za-z_][A-Za-z0-9_]*");

    /** The words of the language, with those for clocks, which some versions have. */
    private static final Set<String> RESERVED = Set.of(
            "int",
            "bool",
            "float",
            "string",
            "true",
            "false",
            "refine",
            "extern",
            "remember",
            "ignore",
            "error",
            "export",
            "function",
            "operator",
            "define",
            "data",
            "package",
            "end",
            "use",
            "as",
            "atom",
            "compound",
            "component",
            "on",
            "internal",
            "do",
            "provided",
            "initial",
            "place",
            "from",
            "at",
            "to",
            "priority",
            "invariant",
            "connector",
            "up",
            "down",
            "port",
            "type",
            "const",
            "if",
            "then",
            "else",
            "fi",
            "clock",
            "unit",
            "nanosecond",
            "microsecond",
            "millisecond",
            "second",
            "minute",
            "hour",
            "day",
            "lazy",
            "delayable",
            "eager",
            "resume",
            "sync",
            "async",
            "when",
            "reset");

    private Names() {}

    static void require(String what, String name) {
        requireNonNull(name, what);
        if (!NAME.matcher(name).matches() || RESERVED.contains(name)) {
            throw new IllegalArgumentException("the " + what + " is called \"" + name + "\", expected "
                    + (RESERVED.contains(name)
                            ? "a name that is no word of the BIP language"
                            : "letters, digits and underscores, and no digit first"));
        }
    }
}
