package io.troupe.demo.verify;

import java.util.List;
import java.util.StringJoiner;
import java.util.function.Function;
import java.util.stream.Stream;

/** Formats the results as Markdown, and as a summary for the terminal. */
final class VerifyReport {
    private final List<ReadingStudy> readings;
    private final List<TeamStudy> teams;
    private final List<WiringStudy> wirings;

    VerifyReport(List<ReadingStudy> readings, List<TeamStudy> teams, List<WiringStudy> wirings) {
        this.readings = List.copyOf(readings);
        this.teams = List.copyOf(teams);
        this.wirings = List.copyOf(wirings);
    }

    static final String TEAMS_TITLE =
            "More robots, each with a separate player: without correction, stopping together, stopping one by one\n";
    static final String WIRINGS_TITLE = "\nWirings declared component by component\n";

    /** One line per statement with its result; traces are only in the Markdown. */
    static String summary(ReadingStudy study) {
        var text = new StringBuilder("Reading ")
                .append(study.reading())
                .append(explanation(study))
                .append('\n');
        for (var statement : study.statements()) {
            text.append(statement.holds() ? "  holds   " : "  DIFFERS ");
            text.append(statement.section())
                    .append(": ")
                    .append(statement.claim())
                    .append('\n');
            text.append("          ours: ").append(statement.ours()).append('\n');
        }
        return text.append('\n').toString();
    }

    static String summary(TeamStudy team) {
        return "  " + team.robots() + (team.robots() == 1 ? " robot:  " : " robots: ") + String.join(", ", cells(team))
                + "\n";
    }

    static String summary(WiringStudy wiring) {
        return "  " + wiring.name() + ": " + wiring.verdict() + "\n";
    }

    private static List<String> cells(TeamStudy team) {
        return Stream.of(team.uncorrected(), team.stoppingTogether(), team.stoppingOneByOne())
                .map(TeamStudy::cell)
                .toList();
    }

    private static String explanation(ReadingStudy study) {
        return switch (study.reading()) {
            case A -> ": service gets ready for data by a separate step";
            case B -> ": service waits for data at once";
        };
    }

    String markdown() {
        var text = new StringBuilder("# The paper's Petri nets, verified again\n\n");
        text.append("""
                The figures with the nets are lost; the text names the places and transitions that composition adds, and the \
                rest is our reconstruction, in two readings. Every number below was computed by this run. A siphon that can lose \
                its tokens proves nothing by itself: a deadlock is only reported where a firing sequence leads to it.

                """);
        text.append("## The nets\n\n");
        text.append(table());
        readings.forEach(study -> statements(text, study));
        text.append(
                "\n## More robots\n\nReading A; each robot has a separate player, and all share one middleware and one service. Dead markings by stubborn sets.\n\n");
        text.append(
                "| robots | without correction | stopping together | each robot with its player |\n|---|---|---|---|\n");
        teams.forEach(team -> text.append("| ")
                .append(team.robots())
                .append(" | ")
                .append(String.join(" | ", cells(team)))
                .append(" |\n"));
        text.append("\n## The wirings\n\n");
        wirings.forEach(wiring -> text.append("### ")
                .append(wiring.name())
                .append("\n\n```\n")
                .append(wiring.result())
                .append("\n```\n\n"));
        return text.toString();
    }

    private String table() {
        List<NetStudy> nets = readings.stream()
                .flatMap(each -> List.of(each.uncorrected(), each.corrected()).stream())
                .toList();
        var table = new StringJoiner("\n", "", "\n");
        table.add(row("", nets, study -> study.net().name()));
        table.add("|---".repeat(nets.size() + 1) + "|");
        table.add(row(
                "places / transitions / arcs",
                nets,
                study -> study.net().places().size() + " / "
                        + study.net().transitions().size() + " / " + study.net().arcCount()));
        table.add(row(
                "reachable markings / edges",
                nets,
                study -> study.graph().size() + " / " + study.graph().edgeCount()));
        table.add(row("most tokens on a place", nets, study -> study.graph().mostTokens()));
        table.add(row("dead markings", nets, study -> study.graph().dead().size()));
        table.add(row("minimal siphons", nets, study -> study.siphons().sets().size()));
        table.add(row(
                "of them emptied in a reachable marking",
                nets,
                study -> study.emptied().size()));
        table.add(row("of them emptied by the state equation", nets, NetStudy::emptiedByTheStateEquation));
        table.add(row(
                "of them without a marked trap",
                nets,
                study -> study.withoutMarkedTrap().size()));
        table.add(row("fewest tokens by the state equation", nets, study -> Math.round(study.fewestTokens())));
        table.add(row("minimal traps", nets, study -> study.traps().sets().size()));
        table.add(row(
                "terminal components (sizes)",
                nets,
                study -> study.liveness().terminalComponents().stream()
                        .map(component -> Integer.toString(component.size()))
                        .toList()));
        table.add(row(
                "live / reversible",
                nets,
                study -> study.liveness().live() + " / " + study.liveness().reversible()));
        return table.toString();
    }

    private static String row(String title, List<NetStudy> nets, Function<NetStudy, Object> cell) {
        var row = new StringJoiner(" | ", "| ", " |");
        row.add(title);
        nets.forEach(study -> row.add(cell.apply(study).toString()));
        return row.toString();
    }

    private static void statements(StringBuilder text, ReadingStudy study) {
        text.append("\n## Reading ")
                .append(study.reading())
                .append(explanation(study))
                .append("\n");
        for (var statement : study.statements()) {
            text.append("\n### ").append(statement.holds() ? "Holds: " : "Differs: ");
            text.append(statement.claim())
                    .append(" (section ")
                    .append(statement.section())
                    .append(")\n\n");
            text.append("Ours: ").append(statement.ours()).append(".\n");
            if (!statement.details().isEmpty()) {
                text.append("\n```\n");
                statement.details().forEach(line -> text.append(line).append('\n'));
                text.append("```\n");
            }
        }
    }
}
