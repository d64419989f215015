package io.troupe.demo.verify;

import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.bip.BipModel;
import io.troupe.petri.bip.BipNet;
import io.troupe.petri.bip.BipStates;
import io.troupe.petri.bip.BipText;
import io.troupe.petri.bip.Interaction;
import io.troupe.petri.bip.PaperBip;
import io.troupe.petri.drawing.BipDrawing;
import io.troupe.services.component.application.ApplicationPlan;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.function.Predicate;
import java.util.stream.Collectors;
import picocli.CommandLine.Model.CommandSpec;

/**
 * {@code troupe verify --bip}: the BIP models of the paper's robots, or of an application. Searches the states of each,
 * compares them with the markings of its net, and writes the text, the drawing and the net.
 */
final class BipStudy {
    static final int FAILED = 1;
    static final int UNKNOWN = 3;

    private static final int MOST_FIRINGS = 12;

    private final CommandSpec spec;
    private final Path out;
    private final SearchLimits limits;
    private final Consumer<String> results;
    private int status;

    /**
     * Prepares a study.
     *
     * @param out a directory, or a file that ends with {@code .bip}, {@code .svg} or {@code .pnml}
     */
    BipStudy(CommandSpec spec, Path out, SearchLimits limits, Consumer<String> results) {
        this.spec = spec;
        this.out = out;
        this.limits = limits;
        this.results = results;
        if (isFile()) {
            FileProblems.checkOutput(spec, "--out", out);
        } else {
            OutputDirectory.make(spec, out);
        }
    }

    private boolean isFile() {
        return !Files.isDirectory(out) && List.of("bip", "svg", "pnml").contains(ending());
    }

    private String ending() {
        var name = String.valueOf(out.getFileName());
        return name.substring(name.lastIndexOf('.') + 1);
    }

    /** The paper's two robots: with and without waiting, and the rules as priorities. */
    int paper() throws IOException {
        var models = List.of(PaperBip.waiting(), PaperBip.notWaiting(), PaperBip.rulesAsPriorities());
        for (var model : models) {
            var states = search(model);
            if (model.components().get("follower1").places().contains("off")) {
                for (var robot = 1; robot <= 2; robot++) {
                    tell(states, "robot " + robot + " has two services that are not off", PaperBip.twoServices(robot));
                }
            }
        }
        if (isFile()) {
            write(models.getFirst());
        } else {
            for (var model : models) {
                write(model);
            }
        }
        return status;
    }

    /** A declared application: what has to hold of each is an error unless it does. */
    int application(ApplicationPlan plan, BipModel model) throws IOException {
        var states = search(model);
        var stuck = states.dead().stream()
                .filter(state -> !ApplicationBip.hasEnded(state))
                .findFirst();
        conclude(
                "nothing can happen any more only when the application has ended"
                        + (states.isComplete() ? "" : ", so far"),
                stuck.isEmpty(),
                stuck.map(state -> "nothing can happen any more in " + state + firings(state))
                        .orElse(""));
        if (states.isComplete()) {
            var lost = states.neverAgain(ApplicationBip::hasEnded);
            conclude(
                    "the application can be ended from every state",
                    lost.isEmpty(),
                    lost.stream()
                            .findFirst()
                            .map(state -> "not from " + state + firings(state))
                            .orElse(""));
        }
        ApplicationBip.fed(plan).forEach((topic, users) -> {
            if (users.stream()
                            .map(each -> each.replaceAll("\\..*", ""))
                            .distinct()
                            .count()
                    > 1) {
                var both = states.find(state -> feeding(state, users) > 1);
                results.accept(both.map(state -> "  the application ends with an error if two needs feed " + topic
                                + firings(state) + "\n")
                        .orElse("  two needs feed " + topic + ": never" + (states.isComplete() ? "\n" : " so far\n")));
            }
        });
        var unused = plan.components().keySet().stream()
                .filter(each -> states.isComplete() && !started(states, ApplicationBip.name(plan, each)))
                .toList();
        if (!unused.isEmpty()) {
            results.accept("  never started: " + String.join(", ", unused) + "\n");
        }
        write(model);
        return status;
    }

    private static boolean started(BipStates states, String component) {
        return states.find(state -> state.isIn(component, "running")).isPresent();
    }

    private static long feeding(BipStates.State state, List<String> users) {
        return users.stream()
                .filter(each -> {
                    var parts = each.split("\\.");
                    return state.isIn(parts[0], parts[1]);
                })
                .count();
    }

    private BipStates search(BipModel model) {
        var states = BipStates.explore(model, limits);
        var text = new StringBuilder("\n").append(model).append("\n  ");
        text.append(states.toString().substring(model.name().length() + 2)).append('\n');
        if (!model.unconnectedPorts().isEmpty()) {
            text.append("  ports without a connector: ")
                    .append(String.join(", ", model.unconnectedPorts()))
                    .append('\n');
        }
        results.accept(text.toString());
        if (states.isComplete()) {
            compare(model, states);
        } else {
            status = Math.max(status, UNKNOWN);
        }
        return states;
    }

    private void compare(BipModel model, BipStates states) {
        Optional<BipNet> translated = net(model);
        if (translated.isEmpty()) {
            return;
        }
        BipNet net = translated.get();
        var graph = ReachabilityGraph.explore(net.net(), limits);
        var same = graph.isComplete()
                && graph.size() == states.size()
                && graph.edgeCount() == states.edgeCount()
                && graph.dead().size() == states.dead().size();
        results.accept("  as a net of " + net.net().places().size() + " places and "
                + net.net().transitions().size() + " transitions: "
                + (same ? "the same" : "NOT THE SAME: " + graph.size() + " markings, " + graph.edgeCount() + " firings")
                + "\n");
        if (graph.isComplete() && !same) { // a defect of this program
            throw new IllegalStateException("the states of " + model + " and the markings of its net differ");
        }
    }

    /** The net of a model, unless it would be too large. */
    private Optional<BipNet> net(BipModel model) {
        try {
            return Optional.of(BipNet.of(model));
        } catch (IllegalArgumentException tooLarge) {
            results.accept("  " + tooLarge.getMessage() + "\n");
            return Optional.empty();
        }
    }

    /** Prints in how many states something holds. */
    private void tell(BipStates states, String what, Predicate<BipStates.State> property) {
        var count = states.count(property);
        var where = states.find(property).map(this::firings).orElse("");
        results.accept("  " + what + ": " + (count == 0 ? "never" : count + " of " + states.size() + " states" + where)
                + (states.isComplete() ? "" : " so far") + "\n");
    }

    private void conclude(String claim, boolean holds, String otherwise) {
        results.accept(holds ? "  " + claim + "\n" : "  WRONG: " + otherwise + "\n");
        if (!holds) {
            status = FAILED;
        }
    }

    private String firings(BipStates.State state) {
        var trace = state.trace();
        return ", first after "
                + trace.stream().limit(MOST_FIRINGS).map(Interaction::toString).collect(Collectors.joining(", "))
                + (trace.size() > MOST_FIRINGS ? " and " + (trace.size() - MOST_FIRINGS) + " more" : "");
    }

    private void write(BipModel model) throws IOException {
        if (isFile()) {
            write(model, out, ending());
        } else {
            for (var kind : List.of("bip", "svg", "pnml")) {
                write(model, out.resolve(model.name() + "." + kind), kind);
            }
        }
    }

    private void write(BipModel model, Path file, String kind) throws IOException {
        if (kind.equals("svg") && !BipDrawing.canDraw(model)) {
            results.accept("  " + model + " is too large for a drawing, expected at most " + BipDrawing.MOST_SVG_PARTS
                    + " components and connectors\n");
            return;
        }
        Optional<String> content = switch (kind) {
            case "svg" -> Optional.of(BipDrawing.of(model).svg());
            case "pnml" -> net(model).map(net -> Pnml.toText(net.net()));
            default -> Optional.of(BipText.of(model));
        };
        if (content.isPresent()) {
            OutputFiles.write(file, content.get());
            results.accept("  wrote " + file + "\n");
        }
    }
}
