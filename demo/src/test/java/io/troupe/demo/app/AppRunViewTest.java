package io.troupe.demo.app;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.CallGraph;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.live.LiveView;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.util.Map;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** What {@code troupe app --view} counts for the page. */
@Timeout(120)
class AppRunViewTest {
    @Test
    void messagesOfTheBus_areCounted() throws Exception {
        try (var page = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.cfg"));
            var text = new StringWriter();
            new AppRun(
                            Path.of("applications", "two-robots.app"),
                            ComponentKinds.standard(),
                            scenario,
                            new AppReport(new PrintWriter(text)),
                            page,
                            null,
                            null)
                    .run(2, false, () -> false);
            Map<String, Long> calls = page.callGraph().snapshot().edges().stream()
                    .filter(edge -> edge.from().space().equals("bus"))
                    .collect(Collectors.toMap(
                            edge -> edge.from().name() + " -> " + edge.to().name(), CallGraph.Edge::calls));
            long readings = 20; // 2 s of 0.1 s
            assertThat(calls)
                    .as("sonar, blobs and odometry of two robots; what the finder and each driver get of them")
                    .containsEntry("robots -> two-robots:application", 2 * 3 * readings)
                    .containsEntry("two-robots:application -> finder", readings)
                    .containsEntry("two-robots:application -> follower", 2 * readings)
                    .containsEntry("two-robots:application -> wanderer", 2 * readings)
                    .hasSize(7);
            assertThat(calls.get("follower -> two-robots:application"))
                    .as("a velocity for each reading, and the stop at the end")
                    .isBetween(readings, readings + 1);
        }
    }
}
