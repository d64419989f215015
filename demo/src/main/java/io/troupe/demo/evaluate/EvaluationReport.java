package io.troupe.demo.evaluate;

import io.troupe.common.text.Plural;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import io.troupe.tools.SampleStatistics;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/** Formats the results for the terminal. */
final class EvaluationReport {
    private final Evaluation.Outcome outcome;
    private final Evaluation.Settings settings;
    private final Measurements measurements;

    EvaluationReport(Evaluation.Outcome outcome) {
        this.outcome = outcome;
        this.settings = outcome.settings();
        this.measurements = outcome.measurements();
    }

    String text() {
        var text = new StringBuilder();
        text.append(machine());
        text.append(String.format(
                Locale.ROOT,
                "%n%d loops of each service, %s; %s%n%n",
                settings.loops(),
                settings.realTime() ? "over TCP, in real time" : "in simulated time with a cycle of 100 ms",
                settings.repetitions() == 1
                        ? "measured once"
                        : "medians of " + settings.repetitions() + " repetitions, in brackets the quartiles"));
        text.append(String.format(
                "  %-9s %-6s %-22s %-22s %-22s %-24s %-22s%n",
                "",
                "cores",
                settings.realTime() ? "time, s" : "simulated time, s",
                "wall follower, us/loop",
                "wanderer, us/loop",
                "both + messages, us/loop",
                "processor time, us/loop"));
        for (Mode mode : settings.modes()) {
            settings.cores().forEach(cores -> text.append(row(mode, cores)));
        }
        text.append(changes());
        text.append("\nThe paper, and what we find\n");
        outcome.claims().forEach(judged -> text.append(paragraph(judged)));
        return text.toString();
    }

    private String machine() {
        int real = Runtime.getRuntime().availableProcessors();
        String machine = String.format(
                Locale.ROOT,
                "Java %s, %s %s, a machine with %d cores%n",
                System.getProperty("java.version"),
                System.getProperty("os.name"),
                System.getProperty("os.arch"),
                real);
        var missing = settings.cores().stream().filter(cores -> cores > real).toList();
        return missing.isEmpty()
                ? machine
                : machine + "told "
                        + missing.stream()
                                .map(cores -> Plural.of(cores, "core"))
                                .collect(Collectors.joining(", "))
                        + ", the machine has " + real
                        + ": that changes how many threads Java starts, not how many run\n";
    }

    private String row(Mode mode, int cores) {
        return String.format(
                "  %-9s %-6d %-22s %-22s %-22s %-24s %-22s%n",
                mode,
                cores,
                seconds(mode, cores),
                text(mode, cores, Measurement.FOLLOWER, Quantity.CYCLE),
                text(mode, cores, Measurement.WANDERER, Quantity.CYCLE),
                text(mode, cores, Measurement.BOTH, Quantity.TURN),
                text(mode, cores, Measurement.BOTH, Quantity.PROCESSOR));
    }

    private String seconds(Mode mode, int cores) {
        double[] millis = measurements.values(Kind.LOOPS, mode, cores, Measurement.BOTH, Quantity.TIME);
        return Measurements.seconds(millis).text(1);
    }

    private String text(Mode mode, int cores, String subject, Quantity quantity) {
        return measurements
                .statistics(Kind.LOOPS, mode, cores, subject, quantity)
                .text(2);
    }

    private String changes() {
        var text = new StringBuilder("\nChanges of state, connection kept");
        text.append(settings.reconnect() ? "; below it with a new connection for each service\n" : "\n");
        for (Kind kind : List.of(Kind.SWITCHES, Kind.RECONNECTS)) {
            for (Mode mode : settings.modes()) {
                for (int cores : settings.cores()) {
                    if (measurements.has(kind, mode, cores, Measurement.BOTH, Quantity.STATE_CHANGES)) {
                        text.append(change(kind, mode, cores));
                    }
                }
            }
        }
        return text.toString();
    }

    private String change(Kind kind, Mode mode, int cores) {
        return String.format(
                "  %-9s %-6d %s changes, %s messages%s%s%n",
                mode,
                cores,
                statistics(kind, mode, cores, Quantity.STATE_CHANGES).text(0),
                statistics(kind, mode, cores, Quantity.SENT).text(0),
                measurements.has(kind, mode, cores, Measurement.BOTH, Quantity.SWITCH_TIME)
                        ? "; until all robots have had a cycle of the next state "
                                + statistics(kind, mode, cores, Quantity.SWITCH_TIME)
                                        .text(0) + " ms"
                        : "",
                kind == Kind.RECONNECTS ? " (connecting anew)" : "");
    }

    private SampleStatistics statistics(Kind kind, Mode mode, int cores, Quantity quantity) {
        return measurements.statistics(kind, mode, cores, Measurement.BOTH, quantity);
    }

    private static String paragraph(PaperClaims.Judged judged) {
        var claim = judged.claim();
        return String.format(
                "%n  %-14s  %s: %s%n                  ours, %s: %s%n                  criterion: %s%n",
                judged.verdict(),
                claim.source(),
                quoted(claim.words()),
                claim.measure(),
                judged.ours(),
                claim.rule().criterion());
    }

    private static String quoted(String words) {
        return words.startsWith("(") ? words : "\"" + words + "\"";
    }
}
