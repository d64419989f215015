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
    private final LatestValue<DeviceData> nothing = new LatestValue<>();

    public Position3DInterface(PlayerClient client) {
        super(client);
    }

    public void setPosition(PlayerPose3d pos, PlayerPose3d vel, int state) {
        throw notSupported();
    }

    public void setPosition(PlayerPosition3dCmdPos value) {
        throw notSupported();
    }

    public void setVelocity(PlayerPose3d vel, int state) {
        throw notSupported();
    }

    public void setVelocity(PlayerPosition3dCmdVel value) {
        throw notSupported();
    }

    public void queryGeometry() {
        throw notSupported();
    }

    public void setMotorPower(int state) {
        throw notSupported();
    }

    public void setControlMode(int state) {
        throw notSupported();
    }

    public void setVelocityControl(int value) {
        throw notSupported();
    }

    public void setOdometry(PlayerPose3d pose) {
        throw notSupported();
    }

    public void resetOdometry() {
        throw notSupported();
    }

    public void setVelocityPIDParams(float kp, float ki, float kd) {
        throw notSupported();
    }

    public void setPositionPIDParams(float kp, float ki, float kd) {
        throw notSupported();
    }

    public void setSpeedProfileParams(float speed, float acc) {
        throw notSupported();
    }

    public PlayerPosition3dData getData() {
        throw notSupported();
    }

    public PlayerPosition3dGeom getGeom() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public boolean isGeomReady() {
        throw notSupported();
    }

    @Override
    public double getX() {
        throw notSupported();
    }

    @Override
    public double getY() {
        throw notSupported();
    }

    public double getZ() {
        throw notSupported();
    }

    @Override
    public double getYaw() {
        throw notSupported();
    }

    public double getPitch() {
        throw notSupported();
    }

    public double getRoll() {
        throw notSupported();
    }

    @Override
    public void setSpeed(double speed, double turnrate) {
        throw notSupported();
    }

    @Override
    LatestValue<?> latest() {
        return nothing;
    }

    @Override
    void accept(DeviceData message) {}

    private PlayerException notSupported() {
        return pc.notSupported("position3d");
    }
}
