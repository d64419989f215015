package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Contact;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A world that is known by requests to its server only. */
@Timeout(120)
class RemoteWorldTest {
    @Test
    void boxThatIsPushed_isWhereTheServerHasIt() throws InterruptedException {
        Map<Long, List<Pose>> moved = new ConcurrentHashMap<>(); // by time
        List<Snapshot> seen = new ArrayList<>();
        try (var simulation = Simulation.open(PushedBox.SCENARIO, WorldSettings.DEFAULT);
                var remote = new RemoteWorld("localhost", 6665, PushedBox.WORLD)) {
            simulation.override(0, 0.3, 0);
            moved.put(0L, simulation.latest().moved());
            var ticking = Thread.ofPlatform().start(() -> {
                for (int tick = 0; tick < 60; tick++) { // each waits until the client requests the next data
                    Snapshot now = simulation.tick();
                    moved.put(now.timeMicros(), now.moved());
                }
            });
            for (int reading = 0; reading < 55; reading++) {
                seen.add(remote.next());
            }
            remote.stop();
            ticking.join();
        }
        assertThat(seen)
                .allSatisfy(each -> assertThat(each.moved())
                        .as("at %d", each.timeMicros())
                        .isEqualTo(moved.get(each.timeMicros())));
        Snapshot last = seen.getLast();
        assertThat(last.moved().getFirst().x()).isGreaterThan(1.2);
        assertThat(last.robots().getFirst().wallGapM())
                .as("from the box, which is in front of the robot")
                .isLessThan(0.03);
        assertThat(seen.stream().flatMap(each -> each.contacts().stream()))
                .extracting(Contact::other)
                .contains("box");
        assertThat(last.displaced(PushedBox.WORLD)).containsOnlyKeys(0);
    }
}
