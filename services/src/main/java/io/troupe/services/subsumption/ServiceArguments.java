package io.troupe.services.subsumption;

import io.troupe.common.text.Suggestions;
import java.math.BigDecimal;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * The arguments of a service in a table file, between the parentheses: tuples of numbers, and words with or without a
 * value, as in {@code (1.5, -2; 3, 0; speed 0.3; again)}.
 *
 * <p><b>Errors.</b> {@link SubsumptionTableException} with the position of the wrong argument.
 */
public final class ServiceArguments {
    /** One argument: a number without a name, a word alone, or a word and its value. */
    private record Item(
            int position,
            @Nullable String name,
            @Nullable Double number,
            @Nullable String word) {
        @Override
        public String toString() {
            String value = number != null ? plain(number) : word == null ? "" : word;
            return name == null ? value : value.isEmpty() ? name : name + " " + value;
        }
    }

    private final TableLine line;
    private final int start;
    private final List<List<Item>> groups = new ArrayList<>();
    private final Set<String> requested = new LinkedHashSet<>();
    private boolean tuplesRequested;

    /** Parses the arguments if the line is at an opening parenthesis; defaultValue there are none. */
    ServiceArguments(TableLine line) {
        this.line = line;
        this.start = line.position();
        if (!line.skips("(") || line.skips(")")) {
            return;
        }
        do {
            groups.add(group());
        } while (line.skips(";"));
        line.expect(")", "or ';' or ','");
    }

    private List<Item> group() {
        List<Item> items = new ArrayList<>();
        do {
            Item item = item();
            if (item.name != null
                    && named(item.name).or(() -> named(items, item.name)).isPresent()) {
                throw line.problem(item.position, "'" + item.name + "' is given twice, expected it once");
            }
            items.add(item);
        } while (line.skips(","));
        return items;
    }

    private Item item() {
        int position = line.position();
        if (line.isAtNumber()) {
            return new Item(position, null, line.number("a number"), null);
        }
        String name = line.word("a number or a word");
        if (line.isAtNumber()) {
            return new Item(position, name, line.number("a number"), null);
        }
        String value = line.nextWord();
        return new Item(position, name, null, value.isEmpty() ? null : line.word("a value"));
    }

    private Optional<Item> named(String name) {
        return groups.stream().flatMap(group -> named(group, name).stream()).findFirst();
    }

    private static Optional<Item> named(List<Item> group, String name) {
        return group.stream().filter(item -> name.equals(item.name)).findFirst();
    }

    /**
     * Returns the groups of plain numbers, in their order.
     *
     * @param size numbers per group
     * @param shape for error messages, such as {@code x, y}
     */
    public List<List<Double>> tuples(int size, String shape) {
        tuplesRequested = true;
        List<List<Double>> tuples = new ArrayList<>();
        for (var group : groups) {
            var numbers = group.stream()
                    .filter(item -> item.name == null)
                    .map(Item::number)
                    .toList();
            if (!numbers.isEmpty()) {
                if (numbers.size() != size || group.size() != size) {
                    throw line.problem(
                            group.getFirst().position,
                            "'" + text(group) + "', expected " + size + " numbers: " + shape
                                    + "; ';' separates groups");
                }
                tuples.add(List.copyOf(numbers));
            }
        }
        return tuples;
    }

    /**
     * Returns the number that follows a word.
     *
     * @param defaultValue the result if the word is absent
     */
    public double number(String name, double defaultValue) {
        requested.add(name);
        var item = named(name);
        Double number = item.map(Item::number).orElse(null);
        if (item.isPresent() && number == null) {
            throw line.problem(item.get().position, "'" + item.get() + "', expected a number after " + name);
        }
        return number == null ? defaultValue : number;
    }

    /** Returns the word that follows a word; the first of the choices if the word is absent. */
    public String choice(String name, List<String> choices) {
        requested.add(name);
        var item = named(name);
        if (item.isEmpty()) {
            return choices.getFirst();
        }
        String word = item.get().word;
        if (word == null || !choices.contains(word)) {
            throw line.problem(
                    item.get().position,
                    "'" + item.get() + "'" + Suggestions.expected("one of", word == null ? "" : word, choices));
        }
        return word;
    }

    /** Whether a word is present, without a value. */
    public boolean flag(String name) {
        requested.add(name);
        var item = named(name);
        if (item.isPresent() && (item.get().number != null || item.get().word != null)) {
            throw line.problem(item.get().position, "'" + item.get() + "', expected " + name + " alone");
        }
        return item.isPresent();
    }

    /** Rejects arguments that the kind of service has not read. */
    void rejectUnused(String kind) {
        for (var group : groups) {
            for (Item item : group) {
                if (item.name == null && !tuplesRequested) {
                    throw line.problem(
                            item.position,
                            kind + " has the number " + item + Suggestions.expected("words", "", requested));
                }
                if (item.name != null && !requested.contains(item.name)) {
                    throw line.problem(
                            item.position,
                            kind + " has the argument '" + item.name + "'"
                                    + Suggestions.expected("one of", item.name, requested));
                }
            }
        }
    }

    int start() {
        return start;
    }

    /** The arguments in canonical form. */
    String text() {
        return String.join("; ", groups.stream().map(ServiceArguments::text).toList());
    }

    private static String text(List<Item> group) {
        return String.join(", ", group.stream().map(Item::toString).toList());
    }

    /** Formats a number as in a table file. */
    static String plain(double number) {
        return number == 0
                ? "0"
                : new BigDecimal(Double.toString(number)).stripTrailingZeros().toPlainString();
    }
}
