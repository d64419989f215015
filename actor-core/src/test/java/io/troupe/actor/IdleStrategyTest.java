package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.internal.loop.Home;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** How long a space waits between two passes, and how often it checks its queues before it sleeps. */
final class IdleStrategyTest {
    private static final int FEW = IdleStrategy.ENOUGH - 1;

    @Test
    void waitDoublesWhileFewMessagesArriveInIt() {
        List<Integer> waits = new ArrayList<>();
        for (int spins = 0; waits.size() < 9; ) {
            spins = IdleStrategy.spinsAfter(spins, FEW);
            waits.add(spins);
        }
        assertThat(waits).containsExactly(1, 2, 4, 8, 16, 32, 64, 64, 64);
    }

    @Test
    void waitStaysWhileEnoughMessagesArriveInIt() {
        assertThat(IdleStrategy.spinsAfter(8, IdleStrategy.ENOUGH)).isEqualTo(8);
        assertThat(IdleStrategy.spinsAfter(8, IdleStrategy.MANY)).isEqualTo(8);
    }

    @Test
    void spaceThatIsBehindItsSenders_orHasOtherWork_doesNotWait() {
        assertThat(IdleStrategy.spinsAfter(8, IdleStrategy.MANY + 1)).isZero();
        assertThat(IdleStrategy.spinsAfter(8, 0)).isZero();
    }

    @Test
    void checksBeforeASleep_fallToNoneWhileTheyFindNothing_andReturnOnceTheyFindWork() {
        List<Integer> numbers = new ArrayList<>();
        for (int checks = IdleStrategy.MOST_CHECKS; numbers.size() < 5; ) {
            checks = IdleStrategy.checksAfter(checks, false);
            numbers.add(checks);
        }
        assertThat(numbers).containsExactly(6, 3, 1, 0, 0);
        assertThat(IdleStrategy.checksAfter(0, true)).isEqualTo(IdleStrategy.MOST_CHECKS);
    }

    @Test
    void arrivalsOfASpaceWithWorkInside_areNoReasonToWait() {
        var space = new SpaceHome(SpaceSettings.named("shop").withoutThread(), null);
        space.enqueueMessage(new Entry(() -> {}));
        space.enqueueMessage(new Entry(() -> {}));
        Home before = space.enter();
        try {
            space.dispatcher.pass();
            assertThat(space.dispatcher.arrivals()).isEqualTo(2);

            space.enqueueMessageLast(new Entry(() -> {
                for (int message = 0; message < 300; message++) {
                    space.enqueueMessage(new Entry(() -> {}));
                }
            }));
            space.dispatcher.pass();
            assertThat(space.dispatcher.arrivals()).as("with 44 messages left").isZero();
            space.dispatcher.pass();
            assertThat(space.dispatcher.isQuiet()).isTrue();
        } finally {
            space.giveUpThread();
            Home.leaveThread(before);
        }
    }
}
