package io.troupe.player;

import static io.troupe.player.wire.Interfaces.RANGER;
import static io.troupe.player.wire.Interfaces.SONAR;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.RangerConfiguration;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** One sonar ring that is served as sonar:0 and as ranger:0, in both dialects: real programs use both. */
@Timeout(60)
class RingTest {
    private static final int PORT = 6791;
    private static final String CLASSIC =
            "ranger ( scount 2 spose[0] [ 0 0 0 ] spose[1] [ 0.05 0 90 ] sview [ 0 5 15 ] )";
    private static final String STAGE_4 = """
            ranger ( pose [ 0 0 0 0 ]
              sensor ( pose [ 0 0 0 0 ] range [ 0 5 ] fov 15 samples 1 )
              sensor ( pose [ 0.05 0 0 90 ] range [ 0 5 ] fov 15 samples 1 ) )""";

    @TempDir
    private Path dir;

    @ParameterizedTest
    @ValueSource(strings = {CLASSIC, STAGE_4})
    void sonarAndRanger_ofOneRobot_areOfferedTogether_andSeeTheSame(String ring) throws IOException {
        Files.writeString(dir.resolve("w.world"), """
                model ( name "wall" pose [ 3 0 0 0 ] size [ 2 2 1 ] )
                position ( name "r" size [ 0.4 0.3 0.2 ] %s )
                """.formatted(ring));
        Path config = Files.writeString(dir.resolve("w.cfg"), """
                driver ( name "stage" provides [ "simulation:0" ] worldfile "w.world" )
                driver ( name "stage" provides [ "%1$d:sonar:0" "%1$d:ranger:0" ] model "r" )
                """.formatted(PORT));
        try (var simulation = Simulation.open(ScenarioReader.readConfig(config), WorldSettings.DEFAULT)) {
            var client = new WireClient(PORT, WireClient.ANSWER);
            client.subscribe(SONAR, 0).subscribe(RANGER, 0);
            simulation.tick();
            simulation.tick();
            assertThat(((DeviceData.SonarRanges) client.newest(SONAR, 0)).rangesM())
                    .containsExactly(2f, 5f);
            assertThat(((DeviceData.RangerRanges) client.newest(RANGER, 0)).rangesM())
                    .containsExactly(2.0, 5.0);

            var sonars = (DeviceReply.SonarGeometry) client.ask(SONAR, 0, new DeviceRequest.Geometry());
            assertThat(sonars.mounts())
                    .isEqualTo(List.of(
                            new DeviceReply.SonarMount(0, 0, 0),
                            new DeviceReply.SonarMount(0.05, 0, StrictMath.PI / 2)));
            var ranger = (DeviceReply.RangerGeometry) client.ask(RANGER, 0, new DeviceRequest.Geometry());
            assertThat(ranger.elementPoses())
                    .extracting(each -> new DeviceReply.SonarMount(each.x(), each.y(), each.yaw()))
                    .isEqualTo(sonars.mounts());
            var configuration = ((DeviceReply.OfRanger) client.ask(RANGER, 0, new DeviceRequest.GetConfiguration()))
                    .configuration();
            assertThat(configuration)
                    .extracting(RangerConfiguration::minRangeM, RangerConfiguration::maxRangeM)
                    .containsExactly(0.0, 5.0);
        }
    }
}
