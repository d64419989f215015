package io.troupe.services.component.application;

import io.troupe.services.broker.Need;
import io.troupe.services.bus.BusTopic;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import io.troupe.services.component.application.Words.Word;
import io.troupe.services.component.kinds.Kinds;
import io.troupe.services.text.Suggestions;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.CharBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

/**
 * Reads the declaration of an application.
 *
 * <p><b>Units and shapes.</b> One statement a line:
 *
 * <pre>
 * application NAME
 * component NAME is KIND [PARAMETER=VALUE ..] [service=NAME] [capabilities=NAME,..]
 * USER needs [service NAME] [capability NAME]
 * connect TOPIC to TOPIC
 * at TIME replace COMPONENT by COMPONENT
 * </pre>
 *
 * A user is the application, a component, or a robot of one. Times are {@code 500ms}, {@code 20s} or {@code 2min}, from
 * when all needs are met.
 *
 * <p><b>Errors.</b> {@link ApplicationFileException}, with the position of the first mistake.
 */
public final class ApplicationReader {
    private static final String BYTE_ORDER_MARK = "\uFEFF"; // some editors write one
    private static final Pattern TIME = Pattern.compile("([0-9]+(?:\\.[0-9]+)?)(ms|s|min)");
    private static final Map<String, Double> MILLIS = Map.of("ms", 1.0, "s", 1_000.0, "min", 60_000.0);
    private static final List<String> STATEMENTS = List.of("application", "component", "connect", "at");
    private static final String STATEMENT = "application, component, connect, at, or a user that needs a service";

    private final Path file;
    private final Kinds kinds;
    private ApplicationPlan plan = ApplicationPlan.named("application");
    private boolean named;

    private ApplicationReader(Path file, Kinds kinds) {
        this.file = file;
        this.kinds = kinds;
    }

    /**
     * Reads a file.
     *
     * @param values of what the file writes as <code>${name}</code>
     * @throws UncheckedIOException if there is no such file
     */
    public static ApplicationPlan read(Path file, Kinds kinds, Map<String, String> values) {
        try {
            return parse(text(file), file, kinds, values);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /**
     * The text of a declaration, as {@link #parse} takes it.
     *
     * @throws ApplicationFileException if it is not UTF-8
     */
    public static String text(Path file) throws IOException {
        if (Files.isDirectory(file)) {
            throw new FileSystemException(file.toString(), null, "a directory, expected the file of a declaration");
        }
        var bytes = ByteBuffer.wrap(Files.readAllBytes(file));
        var text = CharBuffer.allocate(bytes.remaining());
        boolean bad =
                StandardCharsets.UTF_8.newDecoder().decode(bytes, text, true).isError();
        String read = text.flip().toString();
        if (bad) {
            long line = read.chars().filter(each -> each == '\n').count() + 1;
            int column = read.length() - read.lastIndexOf('\n');
            throw new ApplicationFileException(
                    file + ":" + line + ":" + column + ": the byte here is no UTF-8, expected a text in UTF-8");
        }
        return read.startsWith(BYTE_ORDER_MARK) ? read.substring(BYTE_ORDER_MARK.length()) : read;
    }

    /** Reads a text as if it stood in that file. */
    public static ApplicationPlan parse(String text, Path file, Kinds kinds, Map<String, String> values) {
        var reader = new ApplicationReader(file, kinds);
        List<String> lines = text.lines().toList();
        for (int index = 0; index < lines.size(); index++) {
            var words = Words.of(file.toString(), index + 1, lines.get(index), values);
            if (!words.isEmpty()) {
                reader.statement(words);
            }
        }
        if (!reader.named) {
            throw new ApplicationFileException(
                    file + ":1:1: the application has no name, expected a line \"application NAME\"");
        }
        return reader.plan;
    }

    private void statement(Words words) {
        Word first = words.next(STATEMENT);
        switch (first.text()) {
            case "application" -> application(first, words);
            case "component" -> component(words);
            case "connect" -> connect(words);
            case "at" -> replace(words);
            default -> need(first, words);
        }
        words.expectEnd();
    }

    private void application(Word first, Words words) {
        if (named || !plan.components().isEmpty()) {
            throw words.problem(first, "the name of the application stands here, expected it once, on the first line");
        }
        named = true;
        plan = ApplicationPlan.named(words.name("the application's name"));
    }

    private void component(Words words) {
        var read = ComponentStatement.read(words, kinds, directory());
        try {
            plan = plan.with(read.name(), read.component());
        } catch (IllegalArgumentException twice) {
            throw words.problem(read.kind(), twice.getMessage());
        }
    }

    private Path directory() {
        Path parent = file.toAbsolutePath().getParent();
        return parent == null ? Path.of("") : parent;
    }

    private void need(Word user, Words words) {
        var meant = Suggestions.nearest(user.text(), STATEMENTS);
        if (!words.isNext("needs") && (meant.isPresent() || !plan.users().contains(user.text()))) {
            throw words.problem(
                    user,
                    "found \"" + user.text() + "\", expected " + STATEMENT
                            + meant.map(word -> "; did you mean \"" + word + "\"?")
                                    .orElse(""));
        }
        words.expect("needs");
        String service = null;
        String capability = null;
        do {
            Word what = words.next("\"service\" or \"capability\"");
            if (what.text().equals("service") && service == null) {
                service = words.next("a service").text();
            } else if (what.text().equals("capability") && capability == null) {
                capability = words.next("a capability").text();
            } else {
                throw words.problem(
                        what, "found \"" + what.text() + "\", expected \"service\" or \"capability\", each once");
            }
        } while (words.hasNext());
        try {
            plan = plan.needing(new Need(user.text(), service, capability));
        } catch (IllegalArgumentException unknown) {
            throw words.problem(user, unknown.getMessage());
        }
    }

    private void connect(Words words) {
        BusTopic<?> from = topic(words);
        words.expect("to");
        Word target = words.next("a topic");
        BusTopic<?> to = topic(words, target);
        Wire<?> wire = Wiring.wire(from, to)
                .orElseThrow(() -> words.problem(
                        target,
                        to.name() + " is of " + to.type().getSimpleName() + ", expected a topic of "
                                + from.type().getSimpleName() + " as " + from.name() + " is"));
        try {
            plan = connecting(wire);
        } catch (IllegalArgumentException circle) {
            throw words.problem(target, circle.getMessage());
        }
    }

    private <T extends Record> ApplicationPlan connecting(Wire<T> wire) {
        return plan.connecting(wire.from(), wire.to());
    }

    private BusTopic<?> topic(Words words) {
        return topic(words, words.next("a topic"));
    }

    private BusTopic<?> topic(Words words, Word name) {
        List<BusTopic<?>> topics = plan.topics();
        for (var topic : topics) {
            if (topic.name().equals(name.text())) {
                return topic;
            }
        }
        throw words.problem(
                name,
                "no component above has a topic \"" + name.text() + "\"; "
                        + Hints.of(
                                name.text(), topics.stream().map(BusTopic::name).toList()));
    }

    private void replace(Words words) {
        Word time = words.next("a time");
        var match = TIME.matcher(time.text());
        if (!match.matches()) {
            throw words.problem(time, "\"" + time.text() + "\" is no time, expected for example 500ms, 20s or 2min");
        }
        double millis = Double.parseDouble(match.group(1)) * MILLIS.getOrDefault(match.group(2), 1.0);
        words.expect("replace");
        Word old = words.next("a component");
        words.expect("by");
        Word by = words.next("a component");
        try {
            plan = plan.replacing(Duration.ofMillis(StrictMath.round(millis)), old.text(), by.text());
        } catch (IllegalArgumentException unknown) {
            throw words.problem(plan.components().containsKey(old.text()) ? by : old, unknown.getMessage());
        }
    }
}
