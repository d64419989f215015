package io.troupe.demo.verify;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.Verdict;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Our components cannot deadlock. */
class TroupeWiringTest {
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 3})
    void withPromises_isProved(int robots) {
        assertThat(WiringCheck.check(TroupeWiring.withPromises(robots))).isInstanceOf(WiringResult.Proved.class);
    }

    @Test
    void withPromises_ofSixRobots_hasNoDeadMarking() {
        assertThat(DeadlockSearch.run(TroupeWiring.withPromises(6).net()).deadlockFree())
                .isEqualTo(Verdict.YES);
    }

    @Test
    void withDirectCalls_ofTwoRobots_deadlocks() {
        var result = (WiringResult.Deadlock) WiringCheck.check(TroupeWiring.withDirectCalls(2));

        assertThat(result.counterexample().sentence())
                .isEqualTo(
                        "service1 waits for arbitrator.colour; arbitrator waits for service1.stop: all ask and nobody"
                                + " answers");
    }

    /** With a single service no colour is seen while the arbitrator changes the state for another one. */
    @Test
    void withDirectCalls_ofOneRobot_isProved() {
        assertThat(WiringCheck.check(TroupeWiring.withDirectCalls(1))).isInstanceOf(WiringResult.Proved.class);
    }
}
