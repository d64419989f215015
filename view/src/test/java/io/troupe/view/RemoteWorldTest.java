package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
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
    void boxThatIsPushed_isWhereTheServerHasIt_andSensorsReadIt() throws InterruptedException {
        Map<Long, Snapshot> there = new ConcurrentHashMap<>(); // by time
        List<Snapshot> seen = new ArrayList<>();
        try (var simulation = Simulation.open(PushedBox.SCENARIO, WorldSettings.defaults());
                var remote = new RemoteWorld("localhost", 6665, PushedBox.WORLD)) {
            simulation.override(0, 0.3, 0);
            there.put(0L, simulation.latest());
            var ticking = Thread.ofPlatform().start(() -> {
                for (int tick = 0; tick < 60; tick++) { // each waits until the client requests the next data
                    Snapshot now = simulation.tick();
                    there.put(now.timeMicros(), now);
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
                        .isEqualTo(there.get(each.timeMicros()).moved()));
        assertThat(seen).allSatisfy(each -> {
            RobotReading reading = each.robots().getFirst();
            RobotReading truth = there.get(each.timeMicros()).robots().getFirst();
            assertThat(reading.sonarM())
                    .as("at %d", each.timeMicros())
                    .hasSize(2)
                    .isEqualTo(truth.sonarM());
            assertThat(reading.blobs()).isEqualTo(truth.blobs());
        });
        assertThat(seen.stream().skip(1))
                .allSatisfy(
                        each -> assertThat(each.robots().getFirst().odometry().forwardMps())
                                .isCloseTo(0.3, within(0.005)));
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
