package io.troupe.demo.table;

import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe table}: reads and checks a table, prints it, and draws its states and rules. */
@Command(
        name = "table",
        description = "Checks a table of services, prints it, and draws its states and its switching rules.",
        footer = {"  troupe table", "  troupe table four-services.table --out out/four"},
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class TableCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "FILE", arity = "0..1", description = "a table; the paper's unless given")
    private @Nullable Path file;

    @Option(
            names = "--out",
            paramLabel = "DIR",
            description = "where states.dot, states.svg, rules.dot and rules.svg go")
    private Path out = Path.of("out");

    @Mixin
    private ServiceJars jars;

    @Override
    public Integer call() throws IOException {
        SubsumptionTable table = read();
        OutputDirectory.make(spec, out);
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(new TableGrid(table).text());
        terminal.println();
        terminal.flush(); // before writing files, which may fail
        write("states", Diagram.ofStates(table));
        write("rules", Diagram.ofRules(table));
        terminal.println("wrote states and rules, as .dot and .svg, in " + out);
        terminal.flush();
        return 0;
    }

    private SubsumptionTable read() {
        try (var opened = jars) {
            var catalogue = opened.catalogue(file);
            return file == null ? SubsumptionTable.ofThePaper() : ServiceJars.read(spec, file, catalogue);
        }
    }

    private void write(String name, Diagram diagram) throws IOException {
        OutputFiles.write(out.resolve(name + ".dot"), diagram.dot());
        OutputFiles.write(out.resolve(name + ".svg"), DiagramSvg.draw(diagram));
    }

    /** Formats a table as a text grid. */
    private static final class TableGrid {
        /** Up to this number of robots, each has a column. */
        private static final int MOST_COLUMNS = 5;

        private final SubsumptionTable table;

        TableGrid(SubsumptionTable table) {
            this.table = table;
        }

        String text() {
            var text = new StringBuilder();
            text.append(count(table.robots(), "robot")).append(", ");
            text.append(count(table.states().size(), "state")).append(", ");
            text.append(count(
                    (int) table.services().stream()
                            .flatMap(service -> service.layers().stream())
                            .distinct()
                            .count(),
                    "service"));
            text.append("; it begins with state 1\n");
            if (!table.ignored().isEmpty()) {
                text.append("ignored: ")
                        .append(table.ignored().entrySet().stream()
                                .map(entry -> table.colourName(entry.getKey())
                                        + (entry.getValue().isEmpty() ? "" : " (" + entry.getValue() + ")"))
                                .collect(Collectors.joining(", ")))
                        .append('\n');
            }
            if (table.holdSeconds() > 0) {
                text.append("a state lasts ").append(SwitchingRules.plain(table.holdSeconds()));
                text.append(" s or more, unless a colour of higher priority ends it\n");
            }
            text.append('\n');
            List<List<String>> rows = rows();
            int[] widths = IntStream.range(0, rows.getFirst().size())
                    .map(column -> rows.stream()
                            .mapToInt(row -> row.get(column).length())
                            .max()
                            .orElse(0))
                    .toArray();
            for (var row : rows) {
                String line = IntStream.range(0, row.size())
                        .mapToObj(column -> row.get(column)
                                + " ".repeat(widths[column] - row.get(column).length()))
                        .collect(Collectors.joining("  "));
                text.append(line.stripTrailing()).append('\n');
            }
            return text.toString();
        }

        private static String count(int number, String thing) {
            return number + " " + thing + (number == 1 ? "" : "s");
        }

        private List<List<String>> rows() {
            boolean columns = table.robots() <= MOST_COLUMNS;
            boolean priorities = table.states().stream().anyMatch(state -> table.priority(state.colour()) != 0);
            var head = new ArrayList<>(List.of("state", "colour"));
            if (priorities) {
                head.add("priority");
            }
            if (columns) {
                IntStream.rangeClosed(1, table.robots()).forEach(robot -> head.add("robot " + robot));
            } else {
                head.add("robots");
            }
            List<List<String>> rows = new ArrayList<>(List.of(head));
            for (State state : table.states()) {
                var row = new ArrayList<>(List.of(String.valueOf(state.number()), table.colourName(state.colour())));
                if (priorities) {
                    row.add(String.valueOf(table.priority(state.colour())));
                }
                if (columns) {
                    state.services().stream().map(Service::name).forEach(row::add);
                } else {
                    row.add(String.join("; ", RobotGroups.phrases(state, Service::name)));
                }
                rows.add(row);
            }
            return rows;
        }
    }
}
