package io.troupe.services.subsumption;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.LineSyntax;
import io.troupe.common.text.NamedColours;
import io.troupe.common.text.SourceScanner;
import io.troupe.common.text.Suggestions;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.subsumption.ServiceCatalogue.Kind;
import io.troupe.services.subsumption.TableChecks.Subject;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.OptionalInt;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.Stream;

/**
 * Reads tables from text files. A line holds one statement; the order of the lines is free, but the first {@code state}
 * is the state in which a run starts. A {@code #} begins a comment by the rule of {@link LineSyntax}.
 *
 * {@snippet lang = "text":
 * robots 5
 * ignore black : walls                                   # leads to no state; the text after ':' is the reason
 * colour lilac #C8A2C8                                   # declares a colour name, which must be used
 * service patrol = goToGoal(1.5, -2; 3, 0) colours       # or 'no colours': whether its robots look for colours
 * hold 2 s
 * state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, avoid > patrol
 * state lilac priority 2 : * = spaceWanderer, 3..5 = avoid > patrol
 * allow final                                            # allows states in which no robot looks for colours
 * }
 *
 * <p>Colours are names ({@link NamedColours#names()}), or {@code #RRGGBB}. Services are those that the file declares,
 * and the kinds of the catalogue without arguments.
 *
 * <p><b>Errors.</b> {@link SubsumptionTableException} for every error in a file, and if the file cannot be opened.
 */
public final class SubsumptionTableReader {
    private SubsumptionTableReader() {}

    /** Reads a file in UTF-8, with the standard catalogue. */
    public static SubsumptionTable read(Path file) {
        return read(file, ServiceCatalogue.standard());
    }

    /** Reads a file in UTF-8 that may use services of a catalogue. */
    public static SubsumptionTable read(Path file, ServiceCatalogue catalogue) {
        requireNonNull(catalogue, "catalogue");
        try {
            // invalid UTF-8 becomes replacement characters, which the parser reports with their position
            var text = new String(Files.readAllBytes(file), StandardCharsets.UTF_8);
            return new TableParser(file, catalogue).parse(text);
        } catch (NoSuchFileException missing) {
            throw new SubsumptionTableException(file + ": no such file, expected the text of a table", missing);
        } catch (IOException unreadable) {
            if (Files.isDirectory(file)) {
                throw new SubsumptionTableException(
                        file + " is a directory, expected a file with the text of a table", unreadable);
            }
            throw new SubsumptionTableException(
                    file + " cannot be read: " + unreadable + ", expected the text of a table", unreadable);
        }
    }

    /**
     * Parses a text.
     *
     * @param file the text's place in error messages; need not exist
     */
    public static SubsumptionTable parse(String text, Path file, ServiceCatalogue catalogue) {
        return new TableParser(file, catalogue).parse(text);
    }

    /** Parses the declaration of a service, such as {@code patrol = goToGoal(1.5, -2; 3, 0) colours}. */
    public static Service service(String declaration, ServiceCatalogue catalogue) {
        var line = new TableLine(Path.of("service"), 1, declaration);
        Service service = new ServiceReader(catalogue).declare(line);
        line.end();
        return service;
    }

    /**
     * Parses a kind with its arguments, such as {@code goToGoal(1.5, -2; 3, 0)}, for a service outside tables. It has
     * the name of its kind. {@code colours} and {@code no colours} are errors: only a table switches services by
     * colours.
     */
    public static Service kind(String text, ServiceCatalogue catalogue) {
        var line = new TableLine(Path.of("service"), 1, text);
        Service service = new ServiceReader(catalogue).unnamed(line);
        String next = line.nextWord();
        if (next.equals("colours") || next.equals("no")) {
            throw line.unexpected("the end of the line: only the services of tables look for colours");
        }
        line.end();
        return service;
    }

    /** Runs a builder action; an argument that the builder rejects is reported at the given position. */
    private static void atPosition(TableLine line, int position, Supplier<?> action) {
        try {
            action.get();
        } catch (IllegalArgumentException refused) {
            throw line.problem(position, String.valueOf(refused.getMessage()));
        }
    }

    /**
     * Parses a table text: first sorts its lines by keyword, then reads colours and services, then the states that use
     * them.
     */
    private static final class TableParser {
        /** The size of the largest crowd; a table keeps one service for each robot and state in memory. */
        private static final int MOST_ROBOTS = 20_000;

        private enum Keyword {
            ROBOTS,
            IGNORE,
            COLOUR,
            SERVICE,
            HOLD,
            ALLOW,
            STATE;

            @Override
            public String toString() {
                return name().toLowerCase(Locale.ROOT);
            }
        }

        /** A position in the text. */
        private record Place(TableLine line, int position) {}

        private final Path file;
        private final ServiceReader services;
        private final Map<Keyword, List<Place>> statements = new EnumMap<>(Keyword.class);
        private final Map<String, Integer> colours = new LinkedHashMap<>();
        private final Map<Subject, Place> written = new HashMap<>();
        private int robots;

        TableParser(Path file, ServiceCatalogue catalogue) {
            this.file = file;
            this.services = new ServiceReader(catalogue);
        }

        SubsumptionTable parse(String text) {
            // some editors write a byte order mark
            List<String> lines = SourceScanner.withoutMark(text).lines().toList();
            for (int index = 0; index < lines.size(); index++) {
                sort(new TableLine(file, index + 1, lines.get(index)));
            }
            var end = new Place(new TableLine(file, StrictMath.max(1, lines.size()), ""), 0);
            written.put(new Subject.Whole(), end);
            if (!statements.containsKey(Keyword.ROBOTS)) {
                throw problem(end, "the table does not name the number of its robots, expected 'robots N'");
            }
            once(
                    Keyword.ROBOTS,
                    line -> robots = line.whole("a number of robots, 1 to " + MOST_ROBOTS, 1, MOST_ROBOTS));
            SubsumptionTableBuilder builder = SubsumptionTable.forRobots(robots);
            each(Keyword.COLOUR, line -> colour(line, builder));
            each(Keyword.SERVICE, line -> service(line, builder));
            each(Keyword.IGNORE, line -> ignore(line, builder));
            once(Keyword.HOLD, line -> hold(line, builder));
            each(Keyword.ALLOW, line -> {
                line.expect("final", "after 'allow'");
                builder.allowFinal();
            });
            each(Keyword.STATE, line -> state(line, builder));
            builder.finding().ifPresent(finding -> {
                throw problem(written.getOrDefault(finding.subject(), end), finding.message());
            });
            return builder.build();
        }

        private void sort(TableLine line) {
            if (line.atEnd()) {
                return;
            }
            int at = line.position();
            var known = Stream.of(Keyword.values()).map(Keyword::toString).toList();
            String word = line.word("a statement, one of " + String.join(", ", known));
            Keyword keyword = Stream.of(Keyword.values())
                    .filter(each -> each.toString().equals(word))
                    .findFirst()
                    .orElseThrow(() -> line.problem(
                            at, "there is no statement '" + word + "'" + Suggestions.expected("one of", word, known)));
            statements.computeIfAbsent(keyword, each -> new ArrayList<>()).add(new Place(line, at));
        }

        private static SubsumptionTableException problem(Place place, String what) {
            return place.line.problem(place.position, what);
        }

        private void each(Keyword keyword, Consumer<TableLine> read) {
            for (Place place : statements.getOrDefault(keyword, List.of())) {
                read.accept(place.line);
                place.line.end();
            }
        }

        private void once(Keyword keyword, Consumer<TableLine> read) {
            var places = statements.getOrDefault(keyword, List.of());
            if (places.size() > 1) {
                throw problem(places.get(1), "'" + keyword + "' is given twice, expected it once");
            }
            each(keyword, read);
        }

        private void colour(TableLine line, SubsumptionTableBuilder builder) {
            int at = line.position();
            String name = line.word("the name of a colour");
            OptionalInt value = line.atEnd() ? NamedColours.named(name) : line.literalColour();
            if (value.isEmpty()) {
                throw line.atEnd()
                        ? line.problem(
                                at,
                                "the colour '" + name + "' has no value"
                                        + Suggestions.expected(
                                                "#RRGGBB after it, or a known name", name, NamedColours.names()))
                        : line.unexpected("a colour as #RRGGBB");
            }
            colours.put(name, value.getAsInt());
            written.put(new Subject.OfColour(value.getAsInt()), new Place(line, at));
            atPosition(line, at, () -> builder.colour(name, value.getAsInt()));
        }

        private void service(TableLine line, SubsumptionTableBuilder builder) {
            int at = line.position();
            Service service = services.declare(line);
            written.put(new Subject.OfService(service.name()), new Place(line, at));
            builder.service(service);
        }

        private void ignore(TableLine line, SubsumptionTableBuilder builder) {
            int at = line.position();
            int colour = colourName(line);
            String why = line.skips(":") ? line.rest() : "";
            atPosition(line, at, () -> builder.ignoring(colour, why));
        }

        private static void hold(TableLine line, SubsumptionTableBuilder builder) {
            int at = line.position();
            double number = line.number("how long a state lasts, such as '2 s'");
            boolean millis = line.skips("ms");
            if (!millis) {
                line.expect("s", "or 'ms' after the number");
            }
            atPosition(line, at, () -> builder.holdSeconds(millis ? number / 1000 : number));
        }

        private void state(TableLine line, SubsumptionTableBuilder builder) {
            int at = line.position();
            int colour = colourName(line);
            written.put(new Subject.OfState(colour), new Place(line, at));
            if (line.skips("priority")) {
                written.put(new Subject.OfPriority(colour), new Place(line, at));
                int priority = line.whole("a whole number", Integer.MIN_VALUE, Integer.MAX_VALUE);
                atPosition(line, at, () -> builder.priority(colour, priority));
            }
            line.expect(":", "before the services");
            Assignment assignment = new AssignmentParser(line, services, robots).read();
            atPosition(line, at, () -> builder.state(colour, assignment));
        }

        private int colourName(TableLine line) {
            OptionalInt literal = line.literalColour();
            if (literal.isPresent()) {
                return literal.getAsInt();
            }
            int at = line.position();
            String name = line.word("a colour");
            Integer declared = colours.get(name);
            if (declared != null) {
                return declared;
            }
            return NamedColours.named(name).orElseThrow(() -> {
                var known = Stream.concat(colours.keySet().stream(), NamedColours.names().stream())
                        .distinct()
                        .toList();
                return line.problem(
                        at,
                        "there is no colour '" + name + "'"
                                + Suggestions.expected("'colour " + name + " #RRGGBB', or one of", name, known));
            });
        }
    }

    /**
     * Parses the services of a {@code state} statement: either one service per robot in order, or services by robot
     * number.
     */
    private static final class AssignmentParser {
        private final TableLine line;
        private final ServiceReader services;
        private final int robots;
        private Assignment assignment = Assignment.none();

        AssignmentParser(TableLine line, ServiceReader services, int robots) {
            this.line = line;
            this.services = services;
            this.robots = robots;
        }

        Assignment read() {
            if (isAtNumbers()) {
                do {
                    numbered();
                } while (line.skips(","));
            } else {
                inTurn();
            }
            if (!line.atEnd()) {
                throw line.unexpected("',', '>' or the end of the line");
            }
            return assignment;
        }

        private boolean isAtNumbers() {
            return line.isAt("*") || line.isAtNumber();
        }

        /** {@code SERVICE, SERVICE, ..}. */
        private void inTurn() {
            int robot = 0;
            do {
                int at = line.position();
                if (isAtNumbers()) {
                    throw line.unexpected("the service of robot " + (robot + 1) + ", as for those before it");
                }
                Service service = services.layers(line);
                robot++;
                if (robot > robots) {
                    throw line.problem(
                            at,
                            "'" + service + "' is for robot " + robot + ", expected services for " + robots
                                    + " robots");
                }
                assignment = assignment.robot(robot, service);
            } while (line.skips(","));
            if (robot < robots) {
                throw line.unexpected("',' and the service of robot " + (robot + 1) + " of " + robots);
            }
        }

        /** {@code * = SERVICE}, {@code N = SERVICE} or {@code N..M = SERVICE}. */
        private void numbered() {
            int at = line.position();
            if (line.skips("*")) {
                line.expect("=", "and a service after '*'");
                Service service = services.layers(line);
                atPosition(line, at, () -> assignment = assignment.others(service));
                return;
            }
            int first = robot("'*' or the number of a robot, 1 to ");
            int last = line.skips("..") ? robot("the number of a robot, 1 to ") : first;
            line.expect("=", "and a service after the numbers of robots");
            Service service = services.layers(line);
            atPosition(line, at, () -> assignment = assignment.robots(first, last, service));
        }

        private int robot(String expected) {
            return line.whole(expected + robots, 1, robots);
        }
    }

    /** Parses services in a table file: their declarations, and their names with {@code >} between layers. */
    private static final class ServiceReader {
        private final ServiceCatalogue catalogue;
        private final Map<String, Service> declared = new LinkedHashMap<>();

        ServiceReader(ServiceCatalogue catalogue) {
            this.catalogue = catalogue;
        }

        /** {@code NAME = KIND(ARGUMENTS)}, optionally followed by {@code colours} or {@code no colours}. */
        Service declare(TableLine line) {
            int at = line.position();
            String name = line.word("the name of a service");
            if (declared.containsKey(name)) {
                throw line.problem(at, "the service " + name + " is declared already, expected another name");
            }
            line.expect("=", "after the name of a service");
            int kindAt = line.position();
            Kind kind = kind(line);
            if (catalogue.kind(name) != null && !name.equals(kind.name())) {
                throw line.problem(
                        at,
                        "a service of the kind " + kind.name() + " is called " + name
                                + ", which is another kind, expected another name");
            }
            var arguments = new ServiceArguments(line);
            boolean findsColours = line.skips("colours") || !skipsNoColours(line) && kind.findsColours();
            var service = new Service(name, findsColours, kind.usesLaser(), define(line, kindAt, kind, arguments));
            declared.put(name, service);
            return service;
        }

        /** {@code KIND} or {@code KIND(ARGUMENTS)}. */
        Service unnamed(TableLine line) {
            int at = line.position();
            Kind kind = kind(line);
            return new Service(
                    kind.name(),
                    kind.findsColours(),
                    kind.usesLaser(),
                    define(line, at, kind, new ServiceArguments(line)));
        }

        private Kind kind(TableLine line) {
            int at = line.position();
            String name = line.word("a kind of service");
            Kind kind = catalogue.kind(name);
            if (kind == null) {
                throw line.problem(
                        at,
                        "there is no kind of service called '" + name + "'"
                                + Suggestions.expected("one of", name, catalogue.names()));
            }
            return kind;
        }

        private static boolean skipsNoColours(TableLine line) {
            if (!line.skips("no")) {
                return false;
            }
            line.expect("colours", "after 'no'");
            return true;
        }

        private static ServiceDefinition define(TableLine line, int kindAt, Kind kind, ServiceArguments arguments) {
            Supplier<Behaviour> maker;
            try {
                maker = requireNonNull(kind.maker().apply(arguments), "its maker answered nothing");
            } catch (SubsumptionTableException located) {
                throw located;
            } catch (IllegalArgumentException refused) {
                throw line.problem(kindAt, kind.name() + ": " + refused.getMessage());
            } catch (RuntimeException | LinkageError thrown) { // a bug in the kind, which may come from a user's jar
                var problem = line.problem(
                        kindAt, "the kind of service " + kind.name() + " threw " + thrown + ", expected its behaviour");
                problem.initCause(thrown);
                throw problem;
            }
            arguments.rejectUnused(kind.name());
            return new ServiceDefinition(kind.name(), arguments.text(), kind.yields(), maker);
        }

        /** {@code NAME > NAME > ..}, the highest layer first. */
        Service layers(TableLine line) {
            Service service = named(line);
            while (line.skips(">")) {
                service = service.over(named(line));
            }
            if (line.isAt("(")) {
                throw line.problem(
                        line.position(),
                        "arguments of " + service + ", expected them where it gets a name: 'service NAME = KIND(..)'");
            }
            return service;
        }

        private Service named(TableLine line) {
            int at = line.position();
            String name = line.word("a service");
            Service service = declared.get(name);
            if (service != null) {
                return service;
            }
            Kind kind = catalogue.kind(name);
            if (kind == null) {
                var known = new ArrayList<>(declared.keySet());
                catalogue.names().stream()
                        .filter(each -> !declared.containsKey(each))
                        .forEach(known::add);
                throw line.problem(
                        at, "there is no service called '" + name + "'" + Suggestions.expected("one of", name, known));
            }
            return new Service(
                    name,
                    kind.findsColours(),
                    kind.usesLaser(),
                    define(line, at, kind, new ServiceArguments(new TableLine(Path.of(""), 0, ""))));
        }
    }
}
