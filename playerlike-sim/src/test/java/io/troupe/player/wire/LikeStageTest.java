package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerPorts;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Behaviour of a real server with Stage that the protocol does not lead one to expect. */
@Timeout(60)
class LikeStageTest {
    private static final int PORT = 6792;

    private final Simulation simulation = Simulation.open(scenario(), WorldSettings.DEFAULT);

    /** In front of the robot a red box on the left and a green one on the right; the devices in an unusual order. */
    private static Scenario scenario() {
        var world = TestWorlds.world(
                List.of(TestWorlds.robot("one", 0, 0, 0)),
                TestWorlds.wall("left", 3, 1, 0.5, 0.5, TestWorlds.RED),
                TestWorlds.wall("right", 3, -1, 0.5, 0.5, TestWorlds.GREEN));
        var devices = new ArrayList<DeviceBinding>();
        devices.add(new DeviceBinding(PORT, "simulation", 0, "", 0, TestWorlds.NOWHERE));
        for (String type : List.of("sonar", "blobfinder", "position2d")) {
            devices.add(new DeviceBinding(PORT, type, 0, "one", 0, TestWorlds.NOWHERE));
        }
        return new Scenario(world, devices);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    @Test
    void deviceList_hasTheOrderOfProvides() {
        try (var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0);
                var client = RawClient.greeted(server.port())) {
            String here = "0100007f " + String.format("%08x", server.port());
            assertThat(Hex.text(client.ask(new PlayerRequest.DeviceList()).payload()))
                    .isEqualTo(Hex.text(Hex.bytes("00000004 00000004" + here + "0000001f 00000000" + here
                            + "00000005 00000000" + here + "00000007 00000000" + here + "00000004 00000000")));
        }
    }

    @Test
    void commands_whoseStateIsZero_drive() {
        try (var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0);
                var client = RawClient.greeted(server.port())) {
            client.subscribe(Interfaces.POSITION2D);
            client.send(Hex.bytes("00000000 00000000 00000004 00000000 00000002 00000002 0000000000000000 00000000"
                    + "00000034 3ff0000000000000" + "0000000000000000".repeat(5) + "00000000"));
            client.ask(new PlayerRequest.DeviceList()); // wait until the command has arrived
            simulation.tick();
            simulation.tick();
            double goingM = simulation.latest().robots().getFirst().pose().x();
            assertThat(goingM).as("on its way to (1, 0)").isPositive();
            client.next(MessageType.DATA, 4, 1); // one for each tick
            client.next(MessageType.DATA, 4, 1);
            client.send(Hex.bytes("00000000 00000000 00000004 00000000 00000002 00000001 0000000000000000 00000000"
                    + "0000001c bfc999999999999a" + "0000000000000000".repeat(2) + "00000000"));
            client.ask(new PlayerRequest.DeviceList());
            simulation.tick();
            simulation.tick();
            assertThat(simulation.latest().robots().getFirst().odometry().forwardMps())
                    .isEqualTo(-0.2);
        }
    }

    @Test
    void blobs_goOverTheWire_fromRightToLeft() {
        try (var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0);
                var client = RawClient.greeted(server.port())) {
            client.subscribe(Interfaces.BLOBFINDER);
            simulation.tick();
            String data = Hex.text(client.next(MessageType.DATA, 7, 1).payload());
            String size = "00000050" + "0000003c" + "00000002" + "00000002";
            assertThat(data).startsWith(size).hasSize(size.length() + 2 * 80);
            assertThat(data.substring(size.length() + 8, size.length() + 16))
                    .as("the first colour")
                    .isEqualTo("0000ff00");
            assertThat(data.substring(size.length() + 88, size.length() + 96))
                    .as("the second colour")
                    .isEqualTo("00ff0000");
        }
    }

    @Test
    void blobs_ofAClientInThisJvm_areFromRightToLeft_andTheWorldsFromLeftToRight() throws InterruptedException {
        var client = new PlayerClient("localhost", PORT);
        var camera = client.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        Thread ticker = Thread.ofPlatform().daemon().start(() -> simulation.tick());
        client.readAll();
        assertThat(camera.getData().getBlobs())
                .extracting(PlayerBlobfinderBlob::getColor)
                .containsExactly(TestWorlds.GREEN, TestWorlds.RED);
        assertThat(camera.getData().getBlobs()[0].getLeft())
                .isGreaterThan(camera.getData().getBlobs()[1].getRight());
        client.close();
        ticker.join();
        assertThat(simulation.latest().robots().getFirst().blobs().blobs())
                .extracting(blob -> blob.colour())
                .containsExactly(TestWorlds.RED, TestWorlds.GREEN);
    }
}
