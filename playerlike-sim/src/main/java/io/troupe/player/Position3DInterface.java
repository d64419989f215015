package io.troupe.player;

import io.troupe.player.structures.PlayerPose3d;
import io.troupe.player.structures.position3d.PlayerPosition3dCmdPos;
import io.troupe.player.structures.position3d.PlayerPosition3dCmdVel;
import io.troupe.player.structures.position3d.PlayerPosition3dData;
import io.troupe.player.structures.position3d.PlayerPosition3dGeom;
import io.troupe.player.wire.DeviceData;

/**
 * A robot that moves in 3D. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface position3d.
 */
public class Position3DInterface extends AbstractPositionDevice {
    private final Latest<DeviceData> nothing = new Latest<>();

    public Position3DInterface(PlayerClient client) {
        super(client);
    }

    public void setPosition(PlayerPose3d pos, PlayerPose3d vel, int state) {
        throw notOffered();
    }

    public void setPosition(PlayerPosition3dCmdPos value) {
        throw notOffered();
    }

    public void setVelocity(PlayerPose3d vel, int state) {
        throw notOffered();
    }

    public void setVelocity(PlayerPosition3dCmdVel value) {
        throw notOffered();
    }

    public void queryGeometry() {
        throw notOffered();
    }

    public void setMotorPower(int state) {
        throw notOffered();
    }

    public void setControlMode(int state) {
        throw notOffered();
    }

    public void setVelocityControl(int value) {
        throw notOffered();
    }

    public void setOdometry(PlayerPose3d pose) {
        throw notOffered();
    }

    public void resetOdometry() {
        throw notOffered();
    }

    public void setVelocityPIDParams(float kp, float ki, float kd) {
        throw notOffered();
    }

    public void setPositionPIDParams(float kp, float ki, float kd) {
        throw notOffered();
    }

    public void setSpeedProfileParams(float speed, float acc) {
        throw notOffered();
    }

    public PlayerPosition3dData getData() {
        throw notOffered();
    }

    public PlayerPosition3dGeom getGeom() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public boolean isGeomReady() {
        throw notOffered();
    }

    @Override
    public double getX() {
        throw notOffered();
    }

    @Override
    public double getY() {
        throw notOffered();
    }

    public double getZ() {
        throw notOffered();
    }

    @Override
    public double getYaw() {
        throw notOffered();
    }

    public double getPitch() {
        throw notOffered();
    }

    public double getRoll() {
        throw notOffered();
    }

    @Override
    public void setSpeed(double speed, double turnrate) {
        throw notOffered();
    }

    @Override
    Latest<?> latest() {
        return nothing;
    }

    @Override
    void accept(DeviceData message) {}

    private PlayerException notOffered() {
        return pc.notOffered("position3d");
    }
}
