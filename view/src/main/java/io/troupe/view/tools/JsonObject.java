package io.troupe.view.tools;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * A JSON object that has been read from one line.
 *
 * <p><b>Errors.</b> A {@link Problem} for text that is no JSON object, and for a member that is missing or has another
 * type than requested.
 */
final class JsonObject {
    /** What is wrong with a line, and at which column, from 1. */
    static final class Problem extends Exception {
        private static final long serialVersionUID = 1L;

        private final int column;

        Problem(int column, String message) {
            super(message);
            this.column = column;
        }

        int column() {
            return column;
        }
    }

    /** Values are of type String, Double, Boolean, List, Map, or null. */
    private final Map<String, @Nullable Object> members;

    private JsonObject(Map<String, @Nullable Object> members) {
        this.members = members;
    }

    static JsonObject read(String line) throws Problem {
        var reader = new Reader(line);
        reader.skipBlanks();
        Map<String, @Nullable Object> members = reader.object();
        reader.skipBlanks();
        if (reader.at < line.length()) {
            throw reader.expected("nothing after the object");
        }
        return new JsonObject(members);
    }

    boolean has(String name) {
        return members.get(name) != null;
    }

    /** All members that are texts, numbers or truth values, as texts. */
    Map<String, String> texts() {
        Map<String, String> texts = new LinkedHashMap<>();
        members.forEach((name, value) -> {
            if (value instanceof Double number && number == StrictMath.rint(number)) {
                texts.put(name, Long.toString(number.longValue()));
            } else if (value instanceof String || value instanceof Double || value instanceof Boolean) {
                texts.put(name, value.toString());
            }
        });
        return texts;
    }

    String text(String name) throws Problem {
        if (members.get(name) instanceof String text) {
            return text;
        }
        throw wrong(name, "a text");
    }

    boolean truth(String name) throws Problem {
        if (members.get(name) instanceof Boolean truth) {
            return truth;
        }
        throw wrong(name, "true or false");
    }

    double number(String name) throws Problem {
        if (members.get(name) instanceof Double number) {
            return number;
        }
        throw wrong(name, "a number");
    }

    /** A whole number within bounds. */
    int whole(String name, int least, int most) throws Problem {
        if (members.get(name) instanceof Double number
                && number >= least
                && number <= most
                && number == StrictMath.rint(number)) {
            return number.intValue();
        }
        throw wrong(name, "a whole number from " + least + " to " + most);
    }

    List<String> textList(String name) throws Problem {
        List<String> texts = new ArrayList<>();
        for (Object each : list(name, "a list of texts")) {
            if (!(each instanceof String text)) {
                throw wrong(name, "a list of texts");
            }
            texts.add(text);
        }
        return texts;
    }

    /** A whole number from 0 on. */
    long id(String name, long most) throws Problem {
        return id(members.get(name), name, most);
    }

    private long id(@Nullable Object value, String name, long most) throws Problem {
        if (value instanceof Double number && number >= 0 && number <= most && number == StrictMath.rint(number)) {
            return number.longValue();
        }
        throw wrong(name, "whole numbers from 0 to " + most);
    }

    /** A list of whole numbers from 0 on. */
    List<Long> ids(String name, long most) throws Problem {
        List<Long> ids = new ArrayList<>();
        for (Object each : list(name, "a list of numbers")) {
            ids.add(id(each, name, most));
        }
        return ids;
    }

    List<JsonObject> objects(String name) throws Problem {
        List<JsonObject> objects = new ArrayList<>();
        for (Object each : list(name, "a list of objects")) {
            if (!(each instanceof Map<?, ?> map)) {
                throw wrong(name, "a list of objects");
            }
            Map<String, @Nullable Object> of = new LinkedHashMap<>();
            map.forEach((key, value) -> of.put(String.valueOf(key), value));
            objects.add(new JsonObject(of));
        }
        return objects;
    }

    private List<?> list(String name, String expected) throws Problem {
        if (members.get(name) instanceof List<?> list) {
            return list;
        }
        throw wrong(name, expected);
    }

    private Problem wrong(String name, String expected) {
        Object value = members.get(name);
        return new Problem(
                1,
                members.containsKey(name)
                        ? "'" + name + "' is " + (value instanceof String text ? "'" + text + "'" : value)
                                + ", expected " + expected
                        : "there is no '" + name + "', expected " + expected);
    }

    /** Reads one line. */
    private static final class Reader {
        private static final int MOST_DEPTH = 32;

        private final String line;
        private int at;
        private int depth;

        Reader(String line) {
            this.line = line;
        }

        Problem expected(String what) {
            String found = at < line.length() ? "'" + line.charAt(at) + "'" : "the end of the line";
            return new Problem(at + 1, found + ", expected " + what);
        }

        void skipBlanks() {
            while (at < line.length() && " \t\r".indexOf(line.charAt(at)) >= 0) {
                at++;
            }
        }

        private boolean skip(char c) {
            skipBlanks();
            if (at < line.length() && line.charAt(at) == c) {
                at++;
                return true;
            }
            return false;
        }

        private void require(char c, String what) throws Problem {
            if (!skip(c)) {
                throw expected(what);
            }
        }

        private void enter() throws Problem {
            if (++depth > MOST_DEPTH) {
                throw expected("at most " + MOST_DEPTH + " objects and lists in one another");
            }
        }

        Map<String, @Nullable Object> object() throws Problem {
            enter();
            require('{', "a JSON object");
            Map<String, @Nullable Object> members = new LinkedHashMap<>();
            if (!skip('}')) {
                do {
                    skipBlanks();
                    String name = string();
                    require(':', "':' after a name");
                    members.put(name, value());
                } while (skip(','));
                require('}', "',' or '}'");
            }
            depth--;
            return members;
        }

        private List<@Nullable Object> list() throws Problem {
            enter();
            require('[', "'['");
            List<@Nullable Object> elements = new ArrayList<>();
            if (!skip(']')) {
                do {
                    elements.add(value());
                } while (skip(','));
                require(']', "',' or ']'");
            }
            depth--;
            return elements;
        }

        private @Nullable Object value() throws Problem {
            skipBlanks();
            char first = at < line.length() ? line.charAt(at) : '\0';
            return switch (first) {
                case '{' -> object();
                case '[' -> list();
                case '"' -> string();
                case 't' -> word("true", true);
                case 'f' -> word("false", false);
                case 'n' -> word("null", null);
                default -> number();
            };
        }

        private @Nullable Object word(String word, @Nullable Object value) throws Problem {
            if (!line.startsWith(word, at)) {
                throw expected("a value");
            }
            at += word.length();
            return value;
        }

        private Double number() throws Problem {
            int from = at;
            while (at < line.length() && "+-.0123456789eE".indexOf(line.charAt(at)) >= 0) {
                at++;
            }
            try {
                double number = Double.parseDouble(line.substring(from, at));
                if (Double.isFinite(number)) {
                    return number;
                }
            } catch (NumberFormatException noNumber) {
                // reported below
            }
            at = from;
            throw expected("a value");
        }

        private String string() throws Problem {
            require('"', "a name or text in quotes");
            var text = new StringBuilder();
            while (at < line.length() && line.charAt(at) != '"') {
                char c = line.charAt(at++);
                text.append(c == '\\' ? escaped() : c);
            }
            require('"', "'\"' at the end of a text");
            return text.toString();
        }

        private char escaped() throws Problem {
            int which = at < line.length() ? "\"\\/bfnrtu".indexOf(line.charAt(at)) : -1;
            if (which < 0) {
                throw expected("what may follow a backslash in JSON");
            }
            at++;
            if (which < 8) {
                return "\"\\/\b\f\n\r\t".charAt(which);
            }
            if (at + 4 > line.length() || !line.substring(at, at + 4).matches("[0-9a-fA-F]{4}")) {
                throw expected("four hexadecimal digits");
            }
            at += 4;
            return (char) Integer.parseInt(line.substring(at - 4, at), 16);
        }
    }
}
