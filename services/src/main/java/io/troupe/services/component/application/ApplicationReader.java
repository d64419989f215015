package io.troupe.services.component.application;

import io.troupe.broker.Need;
import io.troupe.bus.BusTopic;
import io.troupe.common.text.LineSyntax;
import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.SourceScanner;
import io.troupe.common.text.Suggestions;
import io.troupe.services.component.Component;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import io.troupe.services.component.kinds.ArgumentException;
import io.troupe.services.component.kinds.Arguments;
import io.troupe.services.component.kinds.ComponentKind;
import io.troupe.services.component.kinds.ComponentKinds;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.CharBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;
import java.util.stream.Stream;

/**
 * Reads application files.
 *
 * <p><b>Units and shapes.</b> One statement per line:
 *
 * <pre>
 * application NAME [on NODE,..]
 * component NAME is KIND [PARAMETER=VALUE ..] [service=NAME] [capabilities=NAME,..] [on NODE]
 * USER needs [service NAME] [capability NAME]
 * connect TOPIC to TOPIC
 * at TIME replace COMPONENT by COMPONENT
 * </pre>
 *
 * A user is the application, a component, or a robot of a component. Times are written {@code 500ms}, {@code 20s} or
 * {@code 2min}, and count from the moment when all needs are met. Nodes are the processes on the bus that run the
 * application; the first one runs the application itself and the components without a node.
 *
 * <p><b>Errors.</b> {@link ApplicationFileException}, with the position of the first error.
 */
public final class ApplicationReader {
    private static final Pattern TIME = Pattern.compile("([0-9]+(?:\\.[0-9]+)?)(ms|s|min)");
    private static final Map<String, Double> MILLIS = Map.of("ms", 1.0, "s", 1_000.0, "min", 60_000.0);
    private static final String ON = "on";
    private static final List<String> STATEMENTS = List.of("application", "component", "connect", "at");
    private static final String STATEMENT = "application, component, connect, at, or a user that needs a service";

    private final Path file;
    private final ComponentKinds kinds;
    private ApplicationPlan plan = ApplicationPlan.named("application");
    private boolean named;

    private ApplicationReader(Path file, ComponentKinds kinds) {
        this.file = file;
        this.kinds = kinds;
    }

    /**
     * Reads a file.
     *
     * @param values replacements for <code>${name}</code> in the file
     * @throws UncheckedIOException if the file cannot be read
     */
    public static ApplicationPlan read(Path file, ComponentKinds kinds, Map<String, String> values) {
        try {
            return parse(text(file), file, kinds, values);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /**
     * The text of a file, decoded for {@link #parse}.
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
            var scanner = new SourceScanner(file, read);
            scanner.skip(read.length());
            throw new ApplicationFileException(scanner.where(), "the byte here is no UTF-8, expected a text in UTF-8");
        }
        return SourceScanner.withoutMark(read);
    }

    /** Parses a text; the file is used for error positions and relative paths. */
    public static ApplicationPlan parse(String text, Path file, ComponentKinds kinds, Map<String, String> values) {
        var reader = new ApplicationReader(file, kinds);
        List<String> lines = text.lines().toList();
        for (int index = 0; index < lines.size(); index++) {
            var tokens = new LineTokens(new SourceScanner(file, index + 1, lines.get(index)), values);
            if (!tokens.isEmpty()) {
                reader.statement(tokens);
            }
        }
        if (!reader.named) {
            throw new ApplicationFileException(
                    new SourcePosition(file, 1, 1),
                    "the application has no name, expected a line \"application NAME\"");
        }
        return reader.plan;
    }

    private void statement(LineTokens tokens) {
        Token first = tokens.next(STATEMENT);
        switch (first.text()) {
            case "application" -> application(first, tokens);
            case "component" -> component(tokens);
            case "connect" -> connect(tokens);
            case "at" -> replace(tokens);
            default -> need(first, tokens);
        }
        tokens.expectEnd();
    }

    private void application(Token first, LineTokens tokens) {
        if (named || !plan.components().isEmpty()) {
            throw tokens.error(first, "the name of the application stands here, expected it once, on the first line");
        }
        named = true;
        plan = ApplicationPlan.named(tokens.name("the application's name"));
        if (tokens.hasNext()) {
            tokens.expect(ON);
            Token nodes = tokens.next("nodes with commas between them");
            List<String> names = List.of(nodes.text().split(",", -1));
            if (!names.stream().allMatch(each -> LineTokens.NAME.matcher(each).matches())) {
                throw tokens.error(
                        nodes, "the nodes are \"" + nodes.text() + "\", expected names with commas between them");
            }
            try {
                plan = plan.onNodes(names);
            } catch (IllegalArgumentException twice) {
                throw tokens.error(nodes, twice.getMessage());
            }
        }
    }

    private void component(LineTokens tokens) {
        var read = ComponentStatement.read(tokens, kinds, directory());
        try {
            plan = plan.with(read.name(), read.component());
        } catch (IllegalArgumentException twice) {
            throw tokens.error(read.kind(), twice.getMessage());
        }
        if (tokens.hasNext()) {
            tokens.expect(ON);
            place(read.name(), tokens.next("a node"), tokens);
        }
    }

    private void place(String component, Token node, LineTokens tokens) {
        if (plan.nodes().isEmpty()) {
            throw tokens.error(
                    node, plan.name() + " names no nodes, expected \"application " + plan.name() + " on NODE,NODE\"");
        }
        try {
            plan = plan.placing(component, node.text());
        } catch (IllegalArgumentException unknown) {
            throw tokens.error(node, unknown.getMessage());
        }
    }

    private Path directory() {
        Path parent = file.toAbsolutePath().getParent();
        return parent == null ? Path.of("") : parent;
    }

    private void need(Token user, LineTokens tokens) {
        String meant = Suggestions.clause(user.text(), STATEMENTS);
        if (!tokens.isNext("needs") && (!meant.isEmpty() || !plan.users().contains(user.text()))) {
            throw tokens.error(user, "found \"" + user.text() + "\", expected " + STATEMENT + meant);
        }
        tokens.expect("needs");
        String service = null;
        String capability = null;
        do {
            Token what = tokens.next("\"service\" or \"capability\"");
            if (what.text().equals("service") && service == null) {
                service = tokens.next("a service").text();
            } else if (what.text().equals("capability") && capability == null) {
                capability = tokens.next("a capability").text();
            } else {
                throw tokens.error(
                        what, "found \"" + what.text() + "\", expected \"service\" or \"capability\", each once");
            }
        } while (tokens.hasNext());
        try {
            plan = plan.needing(new Need(user.text(), service, capability));
        } catch (IllegalArgumentException unknown) {
            throw tokens.error(user, unknown.getMessage());
        }
    }

    private void connect(LineTokens tokens) {
        BusTopic<?> from = topic(tokens);
        tokens.expect("to");
        Token target = tokens.next("a topic");
        BusTopic<?> to = topic(tokens, target);
        Wire<?> wire = TopicWiring.wire(from, to)
                .orElseThrow(() -> tokens.error(
                        target,
                        to.name() + " is of " + to.type().getSimpleName() + ", expected a topic of "
                                + from.type().getSimpleName() + " as " + from.name() + " is"));
        try {
            plan = connecting(wire);
        } catch (IllegalArgumentException circle) {
            throw tokens.error(target, circle.getMessage());
        }
    }

    private <T extends Record> ApplicationPlan connecting(Wire<T> wire) {
        return plan.connecting(wire.from(), wire.to());
    }

    private BusTopic<?> topic(LineTokens tokens) {
        return topic(tokens, tokens.next("a topic"));
    }

    private BusTopic<?> topic(LineTokens tokens, Token name) {
        List<BusTopic<?>> topics = plan.topics();
        for (var topic : topics) {
            if (topic.name().equals(name.text())) {
                return topic;
            }
        }
        throw tokens.error(
                name,
                "no component above has a topic \"" + name.text() + "\"; "
                        + Suggestions.hintWithSome(
                                name.text(), topics.stream().map(BusTopic::name).toList()));
    }

    private void replace(LineTokens tokens) {
        Token time = tokens.next("a time");
        var match = TIME.matcher(time.text());
        if (!match.matches()) {
            throw tokens.error(time, "\"" + time.text() + "\" is no time, expected for example 500ms, 20s or 2min");
        }
        double millis = Double.parseDouble(match.group(1)) * MILLIS.getOrDefault(match.group(2), 1.0);
        tokens.expect("replace");
        Token old = tokens.next("a component");
        tokens.expect("by");
        Token by = tokens.next("a component");
        try {
            plan = plan.replacing(Duration.ofMillis(StrictMath.round(millis)), old.text(), by.text());
        } catch (IllegalArgumentException unknown) {
            throw tokens.error(plan.components().containsKey(old.text()) ? by : old, unknown.getMessage());
        }
    }

    /**
     * The statement {@code component NAME is KIND [PARAMETER=VALUE ..]}.
     *
     * @param kind the token that names the kind
     */
    private record ComponentStatement(String name, Token kind, Component<?, ?> component) {
        private static final String SERVICE = "service";
        private static final String CAPABILITIES = "capabilities";

        /** Parses the rest of the line after the word {@code component}. */
        static ComponentStatement read(LineTokens tokens, ComponentKinds kinds, Path directory) {
            String name = tokens.name("the component's name");
            tokens.expect("is");
            Token kindToken = tokens.next("a kind of component");
            ComponentKind kind = kinds.find(kindToken.text())
                    .orElseThrow(() -> tokens.error(
                            kindToken,
                            "there is no kind of component \"" + kindToken.text() + "\"; "
                                    + Suggestions.hintWithSome(
                                            kindToken.text(),
                                            kinds.all().stream()
                                                    .map(ComponentKind::name)
                                                    .toList())));
            Map<String, Token> arguments = arguments(kind, tokens);
            Map<String, String> given = new LinkedHashMap<>();
            arguments.forEach((key, token) -> given.put(key, token.text()));
            List<String> service = names(SERVICE, arguments, tokens);
            List<String> capabilities = names(CAPABILITIES, arguments, tokens);
            given.keySet().removeAll(List.of(SERVICE, CAPABILITIES));
            try {
                var made = kind.factory().create(name, new Arguments(kind, given, directory));
                var offered = made.offering(
                        service.isEmpty() ? made.service() : service.getFirst(),
                        capabilities.isEmpty() ? made.capabilities() : capabilities);
                return new ComponentStatement(name, kindToken, offered);
            } catch (ArgumentException wrong) {
                throw tokens.error(arguments.getOrDefault(wrong.parameter(), kindToken), wrong.getMessage());
            }
        }

        /** The comma-separated names given for a key; empty if the key is missing. */
        private static List<String> names(String key, Map<String, Token> arguments, LineTokens tokens) {
            Token given = arguments.get(key);
            if (given == null) {
                return List.of();
            }
            List<String> names = key.equals(SERVICE)
                    ? List.of(given.text())
                    : Arrays.stream(given.text().split(",", -1))
                            .map(String::strip)
                            .toList();
            if (names.stream().anyMatch(String::isBlank)) {
                throw tokens.error(
                        given,
                        key + " is \"" + given.text() + "\", expected "
                                + (key.equals(SERVICE) ? "a name" : "names with commas between them"));
            }
            return names;
        }

        private static Map<String, Token> arguments(ComponentKind kind, LineTokens tokens) {
            List<String> known = Stream.concat(
                            kind.parameters().stream().map(ComponentKind.Parameter::name),
                            Stream.of(SERVICE, CAPABILITIES))
                    .toList();
            Map<String, Token> arguments = new LinkedHashMap<>();
            while (tokens.hasNext() && !tokens.isNext(ON)) {
                Token token = tokens.next("PARAMETER=VALUE");
                int equals = token.text().indexOf('=');
                if (equals < 1) {
                    throw tokens.error(token, "found \"" + token.text() + "\", expected PARAMETER=VALUE");
                }
                String key = token.text().substring(0, equals);
                if (!known.contains(key)) {
                    throw tokens.error(
                            token,
                            kind.name() + " has no parameter \"" + key + "\"; " + Suggestions.hintWithSome(key, known));
                }
                if (arguments.put(key, new Token(token.text().substring(equals + 1), token.where())) != null) {
                    throw tokens.error(token, "\"" + key + "\" is given twice, expected it once");
                }
            }
            return arguments;
        }
    }

    /** A token without its quotes. */
    private record Token(String text, SourcePosition where) {}

    /**
     * The tokens of one line, which are read one after the other. Blanks separate them, quotes keep blanks in a token,
     * names and comments are those of {@link LineSyntax}, and <code>${name}</code> is replaced by a value of the
     * caller.
     */
    private static final class LineTokens {
        private static final Pattern BLANKS = Pattern.compile("\\p{javaWhitespace}+");
        private static final Pattern PART = Pattern.compile("[^\\p{javaWhitespace}\"]+|\"[^\"]*\"");
        private static final Pattern NAME = Pattern.compile(LineSyntax.NAME);

        private final SourcePosition end;
        private final List<Token> tokens = new ArrayList<>();
        private int next;

        LineTokens(SourceScanner line, Map<String, String> values) {
            SourcePosition start = line.where();
            end = new SourcePosition(
                    start.file(), start.line(), line.text().stripTrailing().length() + 1);
            line.take(BLANKS);
            while (!line.atEnd() && !LineSyntax.isComment(line.text(), line.offset())) {
                SourcePosition where = line.where();
                tokens.add(new Token(substitute(where, unquoted(line, where), values), where));
                line.take(BLANKS);
            }
        }

        private static String unquoted(SourceScanner line, SourcePosition where) {
            var token = new StringBuilder();
            for (String part = line.take(PART); !part.isEmpty(); part = line.take(PART)) {
                token.append(part.replace("\"", ""));
            }
            if (line.isAt("\"")) {
                throw new ApplicationFileException(
                        where, "a quote is not closed, expected \" before the end of the line");
            }
            return token.toString();
        }

        private static String substitute(SourcePosition where, String text, Map<String, String> values) {
            var done = new StringBuilder();
            int at = 0;
            for (int begin = text.indexOf("${"); begin >= 0; begin = text.indexOf("${", at)) {
                int end = text.indexOf('}', begin);
                String name = end < 0 ? "" : text.substring(begin + 2, end);
                if (!values.containsKey(name)) {
                    throw new ApplicationFileException(
                            where,
                            "${" + name + "} has no value here, expected one of "
                                    + values.keySet().stream()
                                            .sorted()
                                            .map(each -> "${" + each + "}")
                                            .toList());
                }
                done.append(text, at, begin).append(values.get(name));
                at = end + 1;
            }
            return done.append(text.substring(at)).toString();
        }

        boolean isEmpty() {
            return tokens.isEmpty();
        }

        boolean hasNext() {
            return next < tokens.size();
        }

        boolean isNext(String token) {
            return hasNext() && tokens.get(next).text().equals(token);
        }

        /**
         * The next token.
         *
         * @param expected description of the token for the error at the end of the line
         */
        Token next(String expected) {
            if (!hasNext()) {
                throw new ApplicationFileException(end, "the line ends here, expected " + expected);
            }
            return tokens.get(next++);
        }

        /** The next token, which must be a name. */
        String name(String expected) {
            Token token = next(expected);
            if (!NAME.matcher(token.text()).matches()) {
                throw error(
                        token,
                        "\"" + token.text() + "\" is no name, expected " + expected + ": letters, digits, . _ and -");
            }
            return token.text();
        }

        /** Skips the next token, which must be the given word. */
        void expect(String token) {
            Token found = next("\"" + token + "\"");
            if (!found.text().equals(token)) {
                throw error(found, "found \"" + found.text() + "\", expected \"" + token + "\"");
            }
        }

        void expectEnd() {
            if (hasNext()) {
                Token found = tokens.get(next);
                throw error(found, "found \"" + found.text() + "\", expected the end of the line");
            }
        }

        ApplicationFileException error(Token at, String what) {
            return new ApplicationFileException(at.where(), what);
        }
    }
}
