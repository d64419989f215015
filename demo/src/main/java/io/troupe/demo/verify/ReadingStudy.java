package io.troupe.demo.verify;

import io.troupe.petri.Composition;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.Stream;

/** The paper's nets in one reading, and the paper's statements about them. */
record ReadingStudy(
        Reading reading,
        NetStudy uncorrected,
        NetStudy corrected,
        NetStudy robotAndPlayer,
        NetStudy middlewareAndService,
        List<Statement> statements) {
    /**
     * A statement of the paper and our result.
     *
     * @param section section of the paper
     * @param claim the paper's statement, abridged
     * @param ours our result
     * @param holds whether our result confirms the statement
     * @param details supporting lines, for example a trace in words
     */
    record Statement(String section, String claim, String ours, boolean holds, List<String> details) {
        Statement {
            details = List.copyOf(details);
        }
    }

    static ReadingStudy of(Reading reading, Consumer<String> progress) {
        progress.accept("reading " + reading + ": the uncorrected net");
        var uncorrected = NetStudy.of(PaperNets.uncorrected(reading));
        progress.accept("reading " + reading + ": the corrected net");
        var corrected = NetStudy.of(PaperNets.corrected(reading));
        progress.accept("reading " + reading + ": pairs of components");
        var robotAndPlayer = NetStudy.of(Composition.compose(
                "robot and player " + reading,
                List.of(PaperNets.robot(), PaperNets.player()),
                List.of(PaperNets.getProxies(), PaperNets.setValues())));
        var middlewareAndService = NetStudy.of(Composition.compose(
                "middleware and service " + reading,
                List.of(PaperNets.middleware(), PaperNets.service(reading)),
                List.of(PaperNets.register(), PaperNets.giveData())));
        progress.accept("reading " + reading + ": the statements");
        var statements = Stream.concat(
                        new UncorrectedStatements(reading, uncorrected).all().stream(),
                        new CorrectedStatements(corrected).all().stream())
                .toList();
        return new ReadingStudy(reading, uncorrected, corrected, robotAndPlayer, middlewareAndService, statements);
    }

    PetriNet lowPriority() {
        return PaperNets.lowPriorityStops(reading);
    }
}
