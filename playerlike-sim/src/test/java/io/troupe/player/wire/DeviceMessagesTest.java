package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.fiducial.PlayerFiducialFov;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The messages of the devices that a world file adds to a robot, over TCP, and in the client.
 *
 * <p>The bytes were made by the XDR functions of the real Player library 3.1.
 */
@Timeout(60)
class DeviceMessagesTest {
    private static final int FIDUCIAL = 10;
    private static final int BUMPER = 14;

    /** The marker is (2, 1) m from the finder and turned by half a radian; the wall presses the first bumper. */
    private static final String WORLD =
            """
            unit_angle "radians"
            position ( name "one" size [ 0.4 0.4 0.2 ] fiducial_return 9
              fiducial ( pose [ 0.25 0 0 0 ] size [ 0.125 0.5 0.1 ] range_min 0.5 range_max 5 fov 1.5 )
              bumper ( bcount 2 blength 0.5 bpose[0] [ 0.25 0 0 0.5 ] bpose[1] [ -0.25 0 0 0 ] blength[1] 0.25 ) )
            model ( pose [ 2.25 1 0 0.5 ] size [ 0.2 0.2 0.5 ] fiducial_return 7 )
            model ( pose [ 0.37 -0.35 0 0 ] size [ 0.2 0.3 0.5 ] )
            """;

    private static Scenario scenario() {
        Scenario read = ScenarioReader.readText(WORLD, Path.of("t.world"));
        return new Scenario(
                read.world(),
                read.devices().stream()
                        .map(each -> new io.troupe.sim.model.DeviceBinding(
                                Served.PORT,
                                each.interfaceName(),
                                each.index(),
                                each.model(),
                                each.ranger(),
                                each.where()))
                        .toList());
    }

    private static String next(RawClient client, MessageType type, int code, int subtype) throws Exception {
        return Hex.text(client.next(type, code, subtype).payload());
    }

    private static String hex(String text) {
        return Hex.text(Hex.bytes(text));
    }

    private static RawClient asked(RawClient client, int code, DeviceRequest request) throws Exception {
        return client.send(RawClient.request(code, 0, RequestCodec.encode(code, request)));
    }

    @Test
    void fiducialFinder_overTcp_sendsTheBytesOfPlayer() throws Exception {
        try (var served = Served.open(scenario())) {
            RawClient client = served.client();
            client.subscribe(Interfaces.FIDUCIAL);
            served.tick(1);
            assertThat(next(client, MessageType.DATA, FIDUCIAL, 1))
                    .isEqualTo(
                            hex(
                                    """
                    00000001 00000001 00000007 40000000 00000000 3ff00000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3fe00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 00000000 00000000 00000000 00000000"""));
            asked(client, FIDUCIAL, new DeviceRequest.Geometry());
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 1))
                    .isEqualTo(
                            hex(
                                    """
                    3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3fe00000 00000000 3fc00000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000"""));
            asked(client, FIDUCIAL, new DeviceRequest.GetFieldOfView());
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 2)).isEqualTo(hex("3f000000 40a00000 3fc00000"));
            asked(client, FIDUCIAL, new DeviceRequest.SetFieldOfView(0.5f, 5, 1.5f));
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 3)).isEqualTo(hex("3f000000 40a00000 3fc00000"));
            asked(client, FIDUCIAL, new DeviceRequest.SetFieldOfView(0, 5, 1.5f));
            assertThat(next(client, MessageType.NACK, FIDUCIAL, 3)).isEmpty();
            asked(client, FIDUCIAL, new DeviceRequest.GetMarker());
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 7)).isEqualTo(hex("00000009"));
            asked(client, FIDUCIAL, new DeviceRequest.SetMarker(9));
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 8)).isEqualTo(hex("00000009"));
            asked(client, FIDUCIAL, new DeviceRequest.SetMarker(3));
            assertThat(next(client, MessageType.NACK, FIDUCIAL, 8)).isEmpty();
        }
    }

    @Test
    void bumpers_overTcp_sendTheBytesOfPlayer() throws Exception {
        try (var served = Served.open(scenario())) {
            RawClient client = served.client();
            client.subscribe(Interfaces.BUMPER);
            served.tick(1);
            assertThat(next(client, MessageType.DATA, BUMPER, 1)).isEqualTo(hex("00000002 00000002 01000000"));
            asked(client, BUMPER, new DeviceRequest.Geometry());
            assertThat(next(client, MessageType.ACK, BUMPER, 1))
                    .isEqualTo(
                            hex(
                                    """
                    00000002 00000002
                    3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    3fe00000 00000000 3f000000 00000000
                    bfd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3e800000 00000000"""));
        }
    }

    @Test
    void decoded_bytesOfPlayer_haveTheirMeaning() throws Exception {
        var pose = new Pose3d(0.25, 0, 0, 0, 0, 0.5);
        assertThat(DataCodec.decode(BUMPER, 1, Hex.bytes("00000005 00000005 01000001 00000000")))
                .contains(new DeviceData.BumperStates(
                        java.util.List.of((byte) 1, (byte) 0, (byte) 0, (byte) 1, (byte) 0)));
        String geometry =
                """
                00000001 00000001 3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                00000000 00000000 3fe00000 00000000 3f000000 40000000""";
        var bumpers =
                new DeviceReply.BumperGeometry(java.util.List.of(new DeviceReply.Bumper(pose, 0.5f, 2)));
        assertThat(ReplyCodec.decode(BUMPER, MessageType.ACK, 1, Hex.bytes(geometry)))
                .isEqualTo(bumpers);
        assertThat(DataCodec.decode(BUMPER, 2, Hex.bytes(geometry)))
                .contains(new DeviceData.GeometryChanged(bumpers));
    }

    /** The client in this JVM and over TCP. */
    private static void inClient(java.util.function.Consumer<PlayerClient> test) throws Exception {
        try (var served = Served.open(scenario());
                var runner = SimulationRunner.start(served.simulation, 1, snapshot -> {})) {
            for (int port : new int[] {Served.PORT, served.port()}) {
                var client = new PlayerClient("localhost", port);
                test.accept(client);
                client.close();
            }
            assertThat(runner.isRunning()).isTrue();
        }
    }

    @Test
    void fiducialInterface_inThisJvmAndOverTcp_hasTheMarkers() throws Exception {
        inClient(client -> {
            var finder = client.requestInterfaceFiducial(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            while (!finder.isDataReady())
                ;
            var seen = finder.getData().getFiducials();
            assertThat(finder.getData().getFiducials_count()).isEqualTo(1);
            assertThat(seen[0].getId()).isEqualTo(7);
            assertThat(seen[0].getPose().getPx()).isEqualTo(2);
            assertThat(seen[0].getPose().getPy()).isEqualTo(1);
            assertThat(seen[0].getPose().getPyaw()).isEqualTo(0.5);
            assertThat(seen[0].getUpose().getPx()).isZero();
            finder.queryGeometry();
            finder.queryFOV();
            finder.queryFiducialVal();
            while (!finder.isGeomReady())
                ;
            while (!finder.isFOVReady())
                ;
            while (!finder.isIDReady())
                ;
            assertThat(finder.getGeom().getSize().getSw()).isEqualTo(0.5);
            assertThat(finder.getGeom().getPose().getPx()).isEqualTo(0.25);
            assertThat(finder.getFOV().getView_angle()).isEqualTo(1.5f);
            assertThat(finder.getID()).isEqualTo(9);
            var same = new PlayerFiducialFov();
            same.setMin_range(0.5f);
            same.setMax_range(5);
            same.setView_angle(1.5f);
            finder.setFov(same);
            while (!finder.isFOVReady())
                ;
            finder.setFiducialVal(9);
            while (!finder.isIDReady())
                ;
        });
    }

    @Test
    void bumperInterface_inThisJvmAndOverTcp_hasTheStates() throws Exception {
        inClient(client -> {
            var bumpers = client.requestInterfaceBumper(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            while (!bumpers.isDataReady())
                ;
            assertThat(bumpers.getData().getBumpers()).containsExactly(1, 0);
            assertThat(bumpers.getData().getBumpers_count()).isEqualTo(2);
            bumpers.queryGeometry();
            while (!bumpers.isGeomReady())
                ;
            assertThat(bumpers.getGeom().getBumper_def_count()).isEqualTo(2);
            assertThat(bumpers.getGeom().getBumper_def()[1].getLength()).isEqualTo(0.25f);
            assertThat(bumpers.getGeom().getBumper_def()[0].getPose().getPyaw()).isEqualTo(0.5);
        });
    }
}
