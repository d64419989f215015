package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.GripperInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.fiducial.PlayerFiducialFov;
import io.troupe.sim.SimulationRunner;
import java.util.List;
import java.util.function.Consumer;
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
    private static final int CAMERA = 40;
    private static final int GRIPPER = 3;
    private static final int RANGER = 62;
    private static final int SIMULATION = 31;

    /** The marker is (2, 1) m from the finder and turned by half a radian; the wall presses the first bumper. */
    private static final String WORLD = """
            unit_angle "radians"
            position ( name "one" size [ 0.4 0.4 0.2 ] fiducial_return 9
              fiducial ( pose [ 0.25 0 0 0 ] size [ 0.125 0.5 0.1 ] range_min 0.5 range_max 5 fov 1.5 )
              camera ( resolution [ 2 2 ] fov [ 1 1 ] )
              gripper ( pose [ 0.25 0 0 0 ] size [ 0.125 0.5 0.75 ] paddle_size [ 0.5 0.25 0.4 ] )
              laser ( samples 2 fov 0.1 range_max 4 )
              bumper ( bcount 2 blength 0.5 bpose[0] [ 0.25 0 0 0.5 ] bpose[1] [ -0.25 0 0 0 ] blength[1] 0.25 ) )
            position ( name "ring" pose [ 0 -3 0 0.5 ] color_rgba [ 1 0.4 0.2 1 ] size [ 0.4 0.4 0.2 ]
              ranger ( sensor () sensor ( pose [ 0 0 0 1.5 ] ) ) )
            model ( pose [ 2.25 1 0 0.5 ] size [ 0.2 0.2 0.5 ] fiducial_return 7 )
            model ( pose [ -0.83 -1.18 0 0 ] size [ 0.4 0.4 0.5 ] )
            model ( pose [ 1.5 0 0 0 ] size [ 0.2 0.2 0.5 ] color_rgba [ 0.2 0.4 0.6 1 ] ranger_return 3 laser_return 1 )
            model ( pose [ 0.37 -0.35 0 0 ] size [ 0.2 0.3 0.5 ] )
            model ( name "light" pose [ -3 3 0 0 ] size [ 0.2 0.2 0.5 ] movable 1 mass 1 )
            model ( name "post" pose [ -3 -3 0 0 ] size [ 0.2 0.2 0.5 ] )
            """;

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
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.FIDUCIAL);
            served.tick(1);
            assertThat(next(client, MessageType.DATA, FIDUCIAL, 1)).isEqualTo(hex("""
                    00000001 00000001 00000007 40000000 00000000 3ff00000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3fe00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 00000000 00000000 00000000 00000000"""));
            asked(client, FIDUCIAL, new DeviceRequest.Geometry());
            assertThat(next(client, MessageType.ACK, FIDUCIAL, 1)).isEqualTo(hex("""
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
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.BUMPER);
            served.tick(1);
            assertThat(next(client, MessageType.DATA, BUMPER, 1)).isEqualTo(hex("00000002 00000002 01000000"));
            asked(client, BUMPER, new DeviceRequest.Geometry());
            assertThat(next(client, MessageType.ACK, BUMPER, 1)).isEqualTo(hex("""
                    00000002 00000002
                    3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    3fe00000 00000000 3f000000 00000000
                    bfd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3e800000 00000000"""));
        }
    }

    @Test
    void camera_overTcp_sendsTheBytesOfPlayer() throws Exception {
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.CAMERA);
            served.tick(1);
            // nothing is as near to the middle as the rays of two columns look aside
            String image = hex("00000002 00000002 00000018 00000005 00000001 00000000 0000000c 0000000c"
                    + "ffffff ffffff c0c0c0 c0c0c0");
            assertThat(next(client, MessageType.DATA, CAMERA, 1)).isEqualTo(image);
            asked(client, CAMERA, new DeviceRequest.GetImage());
            assertThat(next(client, MessageType.ACK, CAMERA, 3)).isEqualTo(image);
            asked(client, CAMERA, new DeviceRequest.Unknown(1)); // the source of the video
            assertThat(next(client, MessageType.NACK, CAMERA, 1)).isEmpty();
        }
        var pixels = new DeviceData.CameraImage(
                2, 1, 24, 5, 1, 0, Octets.of((byte) 1, (byte) 2, (byte) 3, (byte) 4, (byte) 5, (byte) 6));
        String bytes = "00000002 00000001 00000018 00000005 00000001 00000000 00000006 00000006 01020304 05060000";
        assertThat(DataCodec.decode(CAMERA, 1, Hex.bytes(bytes))).contains(pixels);
        assertThat(Hex.text(DataCodec.encode(pixels).payload())).isEqualTo(hex(bytes));
    }

    @Test
    void rangerIntensities_overTcp_areSentToTheClientThatAskedForThem() throws Exception {
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            RawClient other = served.client();
            ranger(client, PlayerRequest.OPEN);
            ranger(other, PlayerRequest.OPEN);
            client.send(RawClient.request(RANGER, 1, RequestCodec.encode(RANGER, new DeviceRequest.Intensities(true))));
            assertThat(client.next().header().type()).isEqualTo(MessageType.ACK);
            served.tick(2);
            assertThat(client.next().header().subtype()).isEqualTo(1);
            assertThat(client.next().header().subtype())
                    .as("measured from then on")
                    .isEqualTo(1);
            WireMessage intensities = client.next();
            assertThat(intensities.header().subtype()).isEqualTo(3);
            assertThat(Hex.text(intensities.payload()))
                    .isEqualTo(hex("00000002 00000002 0000000000000000 3ff0000000000000"));
            other.next();
            other.next();
            other.sync();
        }
    }

    private static void ranger(RawClient client, int mode) throws Exception {
        client.ask(new PlayerRequest.Access(new DeviceAddress(0, 0, RANGER, 1), mode));
    }

    @Test
    void posesIn3dAndProperties_overTcp_haveTheBytesOfPlayer() throws Exception {
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.SIMULATION, Interfaces.POSITION2D);
            served.tick(3);
            for (int i = 0; i < 3; i++) {
                client.nextPosition();
            }
            asked(client, SIMULATION, new DeviceRequest.GetPose3d("ring"));
            assertThat(next(client, MessageType.ACK, SIMULATION, 3)).isEqualTo(hex("""
                    00000005 00000005 72696e67 00000000 0000000000000000 c008000000000000 0000000000000000
                    0000000000000000 0000000000000000 3fe0000000000000 41124f8000000000"""));
            asked(client, SIMULATION, new DeviceRequest.GetProperty("ring", "color", 0, 16));
            assertThat(next(client, MessageType.ACK, SIMULATION, 5))
                    .as("1, 0.4, 0.2 and 1, the least byte first")
                    .isEqualTo(hex("""
                    00000005 00000005 72696e67 00000000 00000006 00000006 636f6c6f 72000000 00000000
                    00000010 00000010 0000803f cdcccc3e cdcc4c3e 0000803f"""));
            asked(client, SIMULATION, new DeviceRequest.GetProperty("one", "time", 0, 8));
            assertThat(next(client, MessageType.ACK, SIMULATION, 5)).isEqualTo(hex("""
                    00000004 00000004 6f6e6500 00000005 00000005 74696d65 00000000 00000000
                    00000008 00000008 e0930400 00000000"""));
            for (var refused : List.of(
                    new DeviceRequest.GetPose3d("none"),
                    new DeviceRequest.GetProperty("none", "color", 0, 16),
                    new DeviceRequest.GetProperty("one", "color", 0, 8),
                    new DeviceRequest.GetProperty("one", "mass", 0, 8),
                    new DeviceRequest.SetProperty("one", "color", 0, Octets.of(new byte[16])),
                    new DeviceRequest.SetPose3d("one", new Pose3d(0, 0, 1, 0, 0, 0), 0),
                    new DeviceRequest.SetPose3d("one", new Pose3d(0, 0, 0, 0, 0.1, 0), 0))) {
                asked(client, SIMULATION, refused);
                assertThat(client.next().header().type()).as("%s", refused).isEqualTo(MessageType.NACK);
            }
            asked(client, SIMULATION, new DeviceRequest.SetPose3d("one", new Pose3d(-2, 1, 0, 0, 0, 0.5), 0));
            assertThat(next(client, MessageType.ACK, SIMULATION, 4)).isEmpty();
            served.tick(1);
            assertThat(client.nextPosition().px())
                    .as("moved at the end of the tick")
                    .isZero();
            served.tick(1);
            DeviceData.Position2d moved = client.nextPosition();
            assertThat(new double[] {moved.px(), moved.py(), moved.pa()}).containsExactly(-2, 1, 0.5);
        }
    }

    @Test
    void obstacles_areMovedByPoseRequests() throws Exception {
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.SIMULATION);
            for (String model : List.of("light", "post")) {
                double away = model.equals("light") ? -4 : -6;
                asked(client, SIMULATION, new DeviceRequest.SetPose(model, 0, 0.1, 0));
                assertThat(client.next().header().type())
                        .as("the robot is there")
                        .isEqualTo(MessageType.NACK);
                asked(client, SIMULATION, new DeviceRequest.SetPose(model, 4, 4, 0.5));
                assertThat(next(client, MessageType.ACK, SIMULATION, 2)).isEmpty();
                served.tick(2);
                asked(client, SIMULATION, new DeviceRequest.GetPose(model));
                assertThat(next(client, MessageType.ACK, SIMULATION, 1))
                        .as("%s", model)
                        .endsWith(hex("4010000000000000 4010000000000000 3fe0000000000000"));
                asked(client, SIMULATION, new DeviceRequest.SetPose3d(model, new Pose3d(away, 4, 0, 0, 0, 0), 0));
                assertThat(next(client, MessageType.ACK, SIMULATION, 4)).isEmpty();
                served.tick(2);
            }
        }
    }

    @Test
    void decoded_bytesOfPlayer_haveTheirMeaning() throws Exception {
        var pose = new Pose3d(0.25, 0, 0, 0, 0, 0.5);
        assertThat(DataCodec.decode(BUMPER, 1, Hex.bytes("00000005 00000005 01000001 00000000")))
                .contains(new DeviceData.BumperStates(List.of((byte) 1, (byte) 0, (byte) 0, (byte) 1, (byte) 0)));
        String geometry = """
                00000001 00000001 3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                00000000 00000000 3fe00000 00000000 3f000000 40000000""";
        var bumpers = new DeviceReply.BumperGeometry(List.of(new DeviceReply.Bumper(pose, 0.5f, 2)));
        assertThat(ReplyCodec.decode(BUMPER, MessageType.ACK, 1, Hex.bytes(geometry)))
                .isEqualTo(bumpers);
        assertThat(DataCodec.decode(BUMPER, 2, Hex.bytes(geometry))).contains(new DeviceData.GeometryChanged(bumpers));
    }

    /** The client in this JVM and over TCP. */
    private static void inClient(Consumer<PlayerClient> test) throws Exception {
        try (var served = Served.open(Served.scenario(WORLD));
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

    @Test
    void cameraInterface_inThisJvmAndOverTcp_hasTheImage() throws Exception {
        inClient(client -> {
            var camera = client.requestInterfaceCamera(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            camera.getImage();
            while (!camera.isDataReady())
                ;
            var image = camera.getData();
            assertThat(new int[] {image.getWidth(), image.getHeight(), image.getBpp(), image.getFormat()})
                    .containsExactly(2, 2, 24, 5);
            assertThat(new int[] {image.getFdiv(), image.getCompression(), image.getImage_count()})
                    .containsExactly(1, 0, 12);
            assertThat(image.getImage()).hasSize(12).startsWith(255, 255, 255);
        });
    }

    @Test
    void simulationInterface_inThisJvmAndOverTcp_hasPosesIn3dAndProperties() throws Exception {
        inClient(client -> {
            var world = client.requestInterfaceSimulation(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            world.get3DPose("ring");
            while (!world.isPose3DReady())
                ;
            assertThat(world.getSimulationPose3D().getPose().getPyaw()).isEqualTo(0.5);
            assertThat(new String(world.getSimulationPose3D().getName())).isEqualTo("ring");
            world.getProperty("ring", "color", 0, 16);
            while (!world.isPropertyReady())
                ;
            assertThat(world.getPropertyValue()).hasSize(16).startsWith(0, 0, 128, 63);
            world.set3DPose("ring", world.getSimulationPose3D().getPose(), 0);
        });
    }

    @Test
    void laserInterface_scanPropertiesWithIntensity_switchesIntensitiesOn() throws Exception {
        inClient(client -> {
            var laser = client.requestInterfaceLaser(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            laser.getScanProperties();
            while (!laser.isReadyPlconfig())
                ;
            var wanted = laser.getPlayerLaserConfig();
            wanted.setIntensity((byte) 1);
            laser.setScanProperties(wanted);
            while (!laser.isReadyPlconfig())
                ;
            assertThat(laser.getPlayerLaserConfig().getIntensity()).isEqualTo((byte) 1);
            do {
                while (!laser.isDataReady())
                    ;
                assertThat(laser.getData().getIntensity_count())
                        .as("0 until they are measured")
                        .isEqualTo(2);
            } while (laser.getData().getIntensity()[0] == 0);
            assertThat(laser.getData().getIntensity()).containsExactly(3, 3);
        });
    }

    @Test
    void gripper_overTcp_obeysAndSendsTheBytesOfPlayer() throws Exception {
        try (var served = Served.open(Served.scenario(WORLD))) {
            RawClient client = served.client();
            client.subscribe(Interfaces.GRIPPER);
            served.tick(1);
            assertThat(next(client, MessageType.DATA, GRIPPER, 1)).isEqualTo(hex("00000001 00000000 00000000"));
            asked(client, GRIPPER, new DeviceRequest.Geometry());
            assertThat(next(client, MessageType.ACK, GRIPPER, 1)).isEqualTo(hex("""
                    3fd00000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000
                    00000000 00000000 3fe00000 00000000 3fc00000 00000000 3fe80000 00000000
                    3fd00000 00000000 3fb00000 00000000 3fe80000 00000000 00000002 00000000"""));
            client.send(Hex.bytes("00000000 00000000 00000003 00000000 00000002 00000002 0000000000000000 00000000"
                    + " 00000000")); // close
            client.sync();
            served.tick(2);
            assertThat(next(client, MessageType.DATA, GRIPPER, 1)).isEqualTo(hex("00000001 00000000 00000000"));
            assertThat(next(client, MessageType.DATA, GRIPPER, 1))
                    .as("it moves")
                    .isEqualTo(hex("00000003 00000000 00000000"));
        }
        assertThat(DataCodec.decode(GRIPPER, 1, Hex.bytes("00000002 0000000c 00000001")))
                .contains(new DeviceData.GripperState(DeviceData.GripperState.CLOSED, 12, 1));
    }

    @Test
    void gripperInterface_inThisJvmAndOverTcp_closesAndOpens() throws Exception {
        inClient(client -> {
            var gripper = client.requestInterfaceGripper(0, PlayerConstants.PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            gripper.queryGeometry();
            while (!gripper.isGeomReady())
                ;
            assertThat(gripper.getGeom().getOuterSize().getSh()).isEqualTo(0.75);
            assertThat(gripper.getGeom().getInnerSize().getSw()).isEqualTo(0.25);
            assertThat(gripper.getGeom().getNumBeams()).isEqualTo((byte) 2);
            gripper.close();
            await(gripper, PlayerConstants.PLAYER_GRIPPER_STATE_CLOSED);
            gripper.stop(); // without effect
            gripper.open();
            await(gripper, PlayerConstants.PLAYER_GRIPPER_STATE_OPEN);
            assertThat(gripper.getData().getBeams()).isZero();
            assertThatThrownBy(() -> gripper.setGripper(6)).hasMessageContaining("expected 1 (open) to 5");
        });
    }

    private static void await(GripperInterface gripper, int state) {
        do {
            while (!gripper.isDataReady())
                ;
        } while (gripper.getData().getState() != state);
    }
}
