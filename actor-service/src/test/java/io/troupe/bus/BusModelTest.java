package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

/** Runs random programs on a bus and on a simple model of it, and compares everything that is received and counted. */
class BusModelTest {
    private static final int PROGRAMS = Integer.getInteger("model.programs", 300);
    private static final long SEED = Long.getLong("model.seed", -1L);

    @Test
    void randomPrograms_onOneNode_showWhatTheModelSays() {
        run(false);
    }

    @Test
    void randomPrograms_onTwoNodesThatExchangeBytes_showWhatTheModelSays() {
        run(true);
    }

    private static void run(boolean twoNodes) {
        if (SEED >= 0) {
            check(SEED, twoNodes);
            return;
        }
        for (long seed = 0; seed < PROGRAMS; seed++) {
            check(seed, twoNodes);
        }
    }

    private static void check(long seed, boolean twoNodes) {
        try (var program = new BusProgram(seed, twoNodes)) {
            program.run();
            assertThat(program.heardOnTheBus())
                    .as("heard; -Dmodel.seed=%d, two nodes: %s, program:%n%s", seed, twoNodes, program)
                    .isEqualTo(program.heardInTheModel());
            assertThat(program.answersOfTheBus())
                    .as("answers; -Dmodel.seed=%d, two nodes: %s, program:%n%s", seed, twoNodes, program)
                    .isEqualTo(program.answersOfTheModel());
            assertThat(program.countedByTheBus())
                    .as("counts; -Dmodel.seed=%d, two nodes: %s, program:%n%s", seed, twoNodes, program)
                    .isEqualTo(program.countedByTheModel());
        }
    }
}
