package io.troupe.demo.verify;

import io.troupe.petri.Arc;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.structure.Siphons;
import java.util.List;

/**
 * Other nets that fit much of the paper's text. Their numbers of siphons show how many readings the paper's number
 * excludes.
 *
 * @param minimalSiphons number of minimal siphons of the net
 */
record OtherReadings(String description, int minimalSiphons) {
    static List<OtherReadings> all() {
        return List.of(
                of("A", uncorrected()),
                of("A, but robot goes on with new proxies (Tr5 leads to R2)", goingOnAt("R2")),
                of("A, but robot sets values again without reading sensors (Tr5 to R6)", goingOnAt("R6")),
                of("A, but middleware wants a new registration each time (Tms4'' to M1)", registeringEachTime()),
                of("A without S3'', which the text does not name", withoutS3()),
                of("A, but player gives new proxies each time (Tpm2'' to P1)", newProxiesEachTime()),
                of("B: service does not get ready by a step of its own", PaperNets.uncorrected(Reading.B)));
    }

    private static OtherReadings of(String description, PetriNet net) {
        return new OtherReadings(description, Siphons.minimalSiphons(net).sets().size());
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
