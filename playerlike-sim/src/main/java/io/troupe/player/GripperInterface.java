package io.troupe.player;

import io.troupe.player.structures.gripper.PlayerGripperData;
import io.troupe.player.structures.gripper.PlayerGripperGeom;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import org.jspecify.annotations.Nullable;

/**
 * A gripper.
 *
 * {@snippet :
 * GripperInterface gripper = robot.requestInterfaceGripper(0, PlayerConstants.PLAYER_OPEN_MODE);
 * gripper.close();
 * do {
 *     while (!gripper.isDataReady())
 *         ;
 * } while (gripper.getData().getState() != PlayerConstants.PLAYER_GRIPPER_STATE_CLOSED);
 * boolean hasSomething = gripper.getData().getBeams() != 0;
 * }
 *
 * <p><b>Units and shapes.</b> Metres and radians, in the robot's frame. States are {@code PLAYER_GRIPPER_STATE_..}; a
 * simulated gripper has two beams, 4 the inner and 8 the outer one.
 *
 * <p><b>Source.</b> Player interface gripper.
 */
public class GripperInterface extends PlayerDevice {
    private final LatestValue<PlayerGripperData> data = new LatestValue<>();
    private final LatestValue<PlayerGripperGeom> geometry = new LatestValue<>();

    public GripperInterface(PlayerClient client) {
        super(client);
    }

    /** The newest state, or null before the first message. */
    public @Nullable PlayerGripperData getData() {
        return data.get();
    }

    /** The newest reply to {@link #queryGeometry}, or null before the first. */
    public @Nullable PlayerGripperGeom getGeom() {
        return geometry.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** True once for each reply to {@link #queryGeometry}. */
    public boolean isGeomReady() {
        return pc.hasReply(geometry);
    }

    /** Requests the pose and sizes of the gripper. */
    public void queryGeometry() {
        ask(new DeviceRequest.Geometry());
    }

    /** Opens the paddles. */
    public void open() {
        setGripper(PLAYER_GRIPPER_CMD_OPEN);
    }

    /** Closes the paddles around what is between them. */
    public void close() {
        setGripper(PLAYER_GRIPPER_CMD_CLOSE);
    }

    /** Stops the paddles; simulated ones do not stop on their way, as with Stage. */
    public void stop() {
        setGripper(PLAYER_GRIPPER_CMD_STOP);
    }

    /** Stores what the gripper holds; a simulated one stores nothing. */
    public void store() {
        setGripper(PLAYER_GRIPPER_CMD_STORE);
    }

    /** Retrieves something from the store; a simulated gripper has none. */
    public void retrieve() {
        setGripper(PLAYER_GRIPPER_CMD_RETRIEVE);
    }

    /** Sends a command by its number, {@code PLAYER_GRIPPER_CMD_..}. */
    public void setGripper(int cmd) {
        if (cmd < PLAYER_GRIPPER_CMD_OPEN || cmd > PLAYER_GRIPPER_CMD_RETRIEVE) {
            throw new PlayerException("gripper command is " + cmd + ", expected 1 (open) to 5 (retrieve)");
        }
        send(new DeviceCommand.Gripper(cmd));
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.GripperState(int state, int beams, int stored)) {
            var newest = new PlayerGripperData();
            newest.setState(state);
            newest.setBeams(beams);
            newest.setStored(stored);
            data.put(newest);
        }
    }

    @Override
    void accept(DeviceReply reply) {
        if (reply instanceof DeviceReply.GripperGeometry gripper) {
            var result = new PlayerGripperGeom();
            result.setPose(StructureConverter.pose(gripper.pose()));
            result.setOuterSize(StructureConverter.box(gripper.outer()));
            result.setInnerSize(StructureConverter.box(gripper.inner()));
            result.setNumBeams((byte) gripper.beams());
            result.setCapacity((byte) gripper.capacity());
            geometry.put(result);
        }
    }
}
