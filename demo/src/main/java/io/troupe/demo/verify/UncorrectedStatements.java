package io.troupe.demo.verify;

import static java.util.Map.entry;

import io.troupe.demo.verify.ReadingStudy.Statement;
import io.troupe.petri.Arc;
import io.troupe.petri.Composition;
import io.troupe.petri.Liveness;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PermanentBlock;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.ReachabilityGraph.State;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.Siphons;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * The paper's statements about the uncorrected net, whose components stop independently, and about low priorities for
 * their stops.
 */
final class UncorrectedStatements {
    private static final int SIPHONS_IN_THE_PAPER = 44;
    private static final List<String> STOPS = List.of("Tr6", "Tr7", "Tp4", "Tm4", "Ts7");

    private final Reading reading;
    private final NetStudy study;
    private final List<PermanentBlock> blocks;

    UncorrectedStatements(Reading reading, NetStudy study) {
        this.reading = reading;
        this.study = study;
        blocks = study.liveness().permanentBlocks(2);
    }

    List<Statement> all() {
        return List.of(
                melding(),
                siphons(),
                emptiedSiphons(),
                deadlock(),
                robotAndPlayer(),
                middlewareAndService(),
                lowPriority());
    }

    private Statement melding() {
        var parts = List.of(PaperNets.robot(), PaperNets.player(), PaperNets.middleware(), PaperNets.service(reading));
        var details = new ArrayList<String>();
        boolean holds = true;
        PetriNet net = Composition.compose("components", parts, List.of());
        for (var meld : PaperNets.melds()) {
            PetriNet melded = Composition.meld(net, List.of(meld));
            var places = added(names(net.places(), Place::name), names(melded.places(), Place::name));
            var transitions =
                    added(names(net.transitions(), Transition::name), names(melded.transitions(), Transition::name));
            details.add(
                    "%s + %s: places %s, transitions %s".formatted(meld.request(), meld.offer(), places, transitions));
            holds &= places.size() == 4 && transitions.size() == 3;
            net = melded;
        }
        return new Statement(
                "5.5",
                "each common transition gives 4 new places and 3 new transitions",
                "so it is for each of the " + details.size()
                        + " melds (the text names no S3'' at the registration, but the" + " rule asks for it)",
                holds,
                details);
    }

    private static <T> List<String> names(List<T> parts, Function<T, String> name) {
        return parts.stream().map(name).toList();
    }

    private static List<String> added(List<String> before, List<String> after) {
        return after.stream().filter(each -> !before.contains(each)).toList();
    }

    private Statement siphons() {
        int count = study.siphons().sets().size();
        var details = new ArrayList<String>();
        details.add("This number does not identify the net: other nets that one could read out of the text have");
        OtherReading.all()
                .forEach(other -> details.add(
                        "  %-72s %3d minimal siphons".formatted(other.description(), other.minimalSiphons())));
        return new Statement(
                "5.5.4",
                "there are 44 minimal siphons",
                count + " minimal siphons, the largest with "
                        + study.siphons().sets().stream()
                                .mapToInt(each -> each.size())
                                .max()
                                .orElse(0) + " places",
                count == SIPHONS_IN_THE_PAPER,
                details);
    }

    private Statement emptiedSiphons() {
        var smallest = study.emptied().stream()
                .min(Comparator.comparingInt(each -> each.size()))
                .map(siphon -> List.of("a smallest one: " + siphon))
                .orElse(List.of());
        return new Statement(
                "5.5.4",
                "linear programs find minimal siphons that can lose all their tokens",
                "%d of them: by the linear programs %d, by visiting all markings %d, and %d contain no marked trap"
                        .formatted(
                                study.emptied().size(),
                                study.emptiedByTheStateEquation(),
                                study.emptied().size(),
                                study.withoutMarkedTrap().size()),
                study.emptiedByTheStateEquation() > 0 && !study.emptied().isEmpty(),
                smallest);
    }

    private Statement deadlock() {
        var dead = study.graph().dead();
        var details = new ArrayList<String>();
        dead.forEach(state -> details.add(
                "%s after %d firings".formatted(state, state.shortestTrace().size())));
        if (!dead.isEmpty()) {
            details.add("the way to the first:");
            details.addAll(TransitionDescriptions.steps(dead.get(0).shortestTrace()));
        }
        blocks.forEach(block -> details.add("never left again once marked together: " + block.places() + ", in "
                + block.markings() + " markings, first after "
                + block.nearest().shortestTrace().size() + " firings"));
        partial().forEach(details::add);
        return new Statement(
                "5.5.4",
                "the net has a deadlock",
                dead.size() + " of " + study.graph().size() + " reachable markings are dead",
                !dead.isEmpty(),
                details);
    }

    /** Terminal components without a dead marking in which some component has stopped for ever. */
    private Stream<String> partial() {
        return study.liveness().terminalComponents().stream()
                .filter(end -> !end.isDead() && !end.neverFired().isEmpty())
                .map(end -> "besides, a partial deadlock: " + end.size()
                        + " markings that are never left again, in which these never fire: " + end.neverFired());
    }

    private Statement robotAndPlayer() {
        return circularWait(
                "player may stop at P4 instead of waiting for values: it waits at Trp1'' and robot at Trp3'' for ever",
                "P1",
                "R7''");
    }

    private Statement middlewareAndService() {
        return circularWait(
                "after Tms2'' service may stop and middleware go on by Tpm1'': service waits at Tms1'' and middleware at"
                        + " Tms3'' for ever",
                "S2''",
                "M8''");
    }

    private Statement circularWait(String claim, String one, String other) {
        var both = study.net().marking(one, other);
        var block = blocks.stream()
                .filter(each -> each.places().equals(both.marked()))
                .findFirst();
        var details = new ArrayList<String>();
        block.ifPresent(found ->
                details.addAll(TransitionDescriptions.steps(found.nearest().shortestTrace())));
        List<State> dead = study.graph().dead();
        String ours = block.map(found ->
                        "%s and %s are marked together in %d markings and never lose their tokens again; first after %d firings; in %d of the %d dead markings"
                                .formatted(
                                        one,
                                        other,
                                        found.markings(),
                                        found.nearest().shortestTrace().size(),
                                        dead.stream()
                                                .filter(state -> state.marking().covers(both))
                                                .count(),
                                        dead.size()))
                .orElse("no such wait found");
        return new Statement("5.5.4", claim, ours, block.isPresent(), details);
    }

    private Statement lowPriority() {
        var graph = ReachabilityGraph.explore(PaperNets.lowPriorityStops(reading));
        List<String> fired = STOPS.stream()
                .filter(stop -> !graph.neverFired().contains(graph.net().transition(stop)))
                .toList();
        boolean neverWantsTo = graph.neverMarked().contains(graph.net().place("R10"));
        return new Statement(
                "5.5.4",
                "stops of lower priority remove the deadlock, but robot never stops",
                "%d markings, %d dead; stops that ever fire: %s; R10 is %s marked; terminal components: %s"
                        .formatted(
                                graph.size(),
                                graph.dead().size(),
                                fired.isEmpty() ? "none" : fired,
                                neverWantsTo ? "never" : "sometimes",
                                Liveness.of(graph).terminalComponents().size()),
                graph.dead().isEmpty() && fired.isEmpty() && neverWantsTo,
                List.of());
    }

    /** Descriptions of the transitions of the paper's nets. */
    private static final class TransitionDescriptions {
        private static final Map<String, String> MEANINGS = Map.ofEntries(
                entry("Tr1", "robot starts"),
                entry("Tr2''", "robot asks player for proxies"),
                entry("Trp1''", "player takes the request for proxies"),
                entry("Tp1", "player makes the proxies"),
                entry("Trp2''", "player gives the proxies to robot"),
                entry("Tr3", "robot reads its sensors"),
                entry("Tr4''", "robot asks player to set values"),
                entry("Trp3''", "player takes the values"),
                entry("Tp2", "player sets the values"),
                entry("Trp4''", "player notifies robot that the values are set"),
                entry("Tr5", "robot goes on"),
                entry("Tr6", "robot decides to stop"),
                entry("Tr7", "robot stops"),
                entry("Tp3''", "player asks middleware to receive the values"),
                entry("Tpm1''", "middleware takes the request of player"),
                entry("Tm3", "middleware receives the values"),
                entry("Tpm2''", "middleware notifies player that it has them"),
                entry("Tp4", "player stops"),
                entry("Ts1''", "service asks middleware to register it"),
                entry("Tms1''", "middleware takes the registration"),
                entry("Tm1", "middleware registers service"),
                entry("Tms2''", "middleware notifies service that it is registered"),
                entry("Tm2''", "middleware asks service to receive data"),
                entry("Tm4", "middleware stops"),
                entry("Ts8", "service gets ready for data"),
                entry("Tms3''", "service takes the request of middleware"),
                entry("Ts2", "service receives the data"),
                entry("Tms4''", "service notifies middleware that it has them"),
                entry("Ts3", "service chooses the wall follower"),
                entry("Ts4", "service chooses the space wanderer"),
                entry("Ts5", "service follows the wall"),
                entry("Ts6", "service wanders"),
                entry("Ts7", "service stops"),
                entry("Tstop", "all four stop together"));

        private TransitionDescriptions() {}

        /** A trace in words, one line per firing, for example {@code 8. Tp4: player stops}. */
        static List<String> steps(List<Transition> trace) {
            return IntStream.range(0, trace.size())
                    .mapToObj(i -> "%2d. %-7s %s"
                            .formatted(
                                    i + 1,
                                    trace.get(i).name(),
                                    meaning(trace.get(i).name())))
                    .toList();
        }

        static String meaning(String transition) {
            var meaning = MEANINGS.get(transition);
            if (meaning == null) {
                throw new IllegalArgumentException("there are no words for the transition " + transition);
            }
            return meaning;
        }
    }

    /**
     * Another net that fits much of the paper's text. The numbers of siphons show how many readings the paper's number
     * excludes.
     *
     * @param minimalSiphons number of minimal siphons of the net
     */
    record OtherReading(String description, int minimalSiphons) {
        static List<OtherReading> all() {
            return List.of(
                    of("A", uncorrected()),
                    of("A, but robot goes on with new proxies (Tr5 leads to R2)", goingOnAt("R2")),
                    of("A, but robot sets values again without reading sensors (Tr5 to R6)", goingOnAt("R6")),
                    of("A, but middleware wants a new registration each time (Tms4'' to M1)", registeringEachTime()),
                    of("A without S3'', which the text does not name", withoutS3()),
                    of("A, but player gives new proxies each time (Tpm2'' to P1)", newProxiesEachTime()),
                    of("B: service does not get ready by a separate step", PaperNets.uncorrected(Reading.B)));
        }

        private static OtherReading of(String description, PetriNet net) {
            return new OtherReading(
                    description, Siphons.minimalSiphons(net).sets().size());
        }

        private static PetriNet uncorrected() {
            return PaperNets.uncorrected(Reading.A);
        }

        private static PetriNet goingOnAt(String place) {
            return changed("Tr5", List.of("R9"), List.of(place));
        }

        private static PetriNet registeringEachTime() {
            return changed("Tms4''", List.of("M9''", "S6''"), List.of("M1", "S7"));
        }

        private static PetriNet newProxiesEachTime() {
            return changed("Tpm2''", List.of("P9''", "M6''"), List.of("P1", "M7"));
        }

        private static PetriNet changed(String transition, List<String> in, List<String> out) {
            return uncorrected().toBuilder()
                    .remove(transition)
                    .transition(transition, in, out)
                    .build();
        }

        /** Removes S3 by rebuilding the net: as an isolated place it would add a minimal siphon. */
        private static PetriNet withoutS3() {
            var net = uncorrected();
            var copy = PetriNet.builder("without S3''");
            for (var place : net.places()) {
                if (!place.name().equals("S3''")) {
                    copy.place(place.name(), net.initialMarking().tokens(place));
                }
            }
            for (var transition : net.transitions()) {
                copy.transition(transition.name(), others(transition.inputs()), others(transition.outputs()));
            }
            return copy.build();
        }

        private static List<String> others(List<Arc> arcs) {
            return arcs.stream()
                    .map(arc -> arc.place().name())
                    .filter(name -> !name.equals("S3''"))
                    .toList();
        }
    }
}
