package io.troupe.petri.examples;

import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.ends;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.refuses;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.wiring.Branch;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringProgress;
import io.troupe.petri.wiring.WiringProgress.Fails;
import io.troupe.petri.wiring.WiringResult;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/**
 * Two participants commit together, or not at all. A participant that gives up by itself blocks no other; whether the
 * two agree is a question about safety.
 */
class TwoPhaseCommitTest {
    /** Each of two participants votes, and the coordinator commits if both agree; one may give up by itself. */
    private static Wiring commit(boolean alone) {
        var coordinator = Protocol.of("coordinator")
                .state("new", requests("p1.prepare").then("first").orRejected("aborting 2"))
                .state("first", requests("p2.prepare").then("committing 1").orRejected("aborting 1"))
                .state("committing 1", requests("p1.commit").then("committing 2"))
                .state("committing 2", requests("p2.commit").then("over"))
                .state("aborting 1", requests("p1.abort").then("over"))
                .state("aborting 2", requests("p2.abort").then("over"))
                .state("over", ends())
                .build();
        var ways = new ArrayList<>(
                List.of(provides("commit").then("committed"), provides("abort").then("aborted")));
        if (alone) {
            ways.add(does("time out").then("gave up"));
        }
        var participant = Protocol.of("participant")
                .state(
                        "new",
                        accepts("prepare").then("asked"),
                        provides("abort").then("aborted"))
                .state(
                        "asked",
                        answers("prepare").then("prepared"),
                        refuses("prepare").then("aborted"))
                .state("prepared", ways.toArray(new Branch[0]))
                .state("committed", ends())
                .state("aborted", ends());
        if (alone) {
            participant.state(
                    "gave up",
                    provides("commit").then("aborted"),
                    provides("abort").then("aborted"));
        }
        return Wiring.of("commit")
                .component(coordinator)
                .components("p", 2, participant.build())
                .build();
    }

    @Test
    void participants_neverDisagree_unlessOneGivesUpAlone() {
        for (var alone : new boolean[] {false, true}) {
            var wiring = commit(alone);
            assertThat(WiringCheck.check(wiring)).isInstanceOf(WiringResult.Proved.class);
            var progress = WiringProgress.of(wiring);
            var disagree = progress.never(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted")));
            assertThat(disagree).isInstanceOf(alone ? No.class : Yes.class);
            var both = (Yes<Fails>) progress.canReach(Map.of("p1", Set.of("committed"), "p2", Set.of("committed")));
            assertThat(both.proof()).endsWith("coordinator calls p2.commit, which answers");
            assertThat(progress.alwaysAgain("coordinator", "over")).isInstanceOf(Yes.class);
        }
        var apart = Map.of("p1", Set.of("committed"), "p2", Set.of("aborted"));
        var never = (No<Fails>) WiringProgress.of(commit(false)).canReach(apart);
        assertThat(never.counterexample()).hasToString("never at once: p1 is committed, p2 is aborted");
    }

    @Test
    void samples() {
        var commit = commit(false);
        var progress = WiringProgress.of(commit);
        assertThat(progress.never(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted"))))
                .isInstanceOf(Yes.class);
        assertThat(progress.canReach(Map.of("p1", Set.of("committed")))).isInstanceOf(Yes.class);
        assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Yes.class);
        assertThat(progress.alwaysAgain("coordinator", "over")).isInstanceOf(Yes.class);
    }
}
