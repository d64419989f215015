package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;

/**
 * The interfaces of the Player Java client that are not offered here, so that a program that asks for one is told at run time what there is.
 *
 * <p><b>Errors.</b> Each of these throws {@link PlayerException}, which names the device asked for, the interfaces this client offers and the devices the
 * server has.
 */
abstract class UnofferedInterfaces extends Thread implements PlayerConstants {
    UnofferedInterfaces(String threadName) {
        super(threadName);
    }

    abstract PlayerException notOffered(String device);

    public PlayerDevice requestInterfacePower(int index, int access) {
        throw notOffered("power:" + index);
    }

    public PlayerDevice requestInterfaceGripper(int index, int access) {
        throw notOffered("gripper:" + index);
    }

    public PlayerDevice requestInterfacePtz(int index, int access) {
        throw notOffered("ptz:" + index);
    }

    public PlayerDevice requestInterfaceFiducial(int index, int access) {
        throw notOffered("fiducial:" + index);
    }

    public PlayerDevice requestInterfaceSpeech(int index, int access) {
        throw notOffered("speech:" + index);
    }

    public PlayerDevice requestInterfaceGPS(int index, int access) {
        throw notOffered("gps:" + index);
    }

    public PlayerDevice requestInterfaceBumper(int index, int access) {
        throw notOffered("bumper:" + index);
    }

    public PlayerDevice requestInterfaceDIO(int index, int access) {
        throw notOffered("dio:" + index);
    }

    public PlayerDevice requestInterfaceAIO(int index, int access) {
        throw notOffered("aio:" + index);
    }

    public PlayerDevice requestInterfaceIR(int index, int access) {
        throw notOffered("ir:" + index);
    }

    public PlayerDevice requestInterfaceWiFi(int index, int access) {
        throw notOffered("wifi:" + index);
    }

    public PlayerDevice requestInterfaceWaveform(int index, int access) {
        throw notOffered("waveform:" + index);
    }

    public PlayerDevice requestInterfaceLocalize(int index, int access) {
        throw notOffered("localize:" + index);
    }

    public PlayerDevice requestInterfaceMCom(int index, int access) {
        throw notOffered("mcom:" + index);
    }

    public PlayerDevice requestInterfaceSound(int index, int access) {
        throw notOffered("sound:" + index);
    }

    public PlayerDevice requestInterfaceAudioDSP(int index, int access) {
        throw notOffered("audiodsp:" + index);
    }

    public PlayerDevice requestInterfaceAudioMixer(int index, int access) {
        throw notOffered("audiomixer:" + index);
    }

    public PlayerDevice requestInterfacePosition3D(int index, int access) {
        throw notOffered("position3d:" + index);
    }

    public PlayerDevice requestInterfaceBlinkenlight(int index, int access) {
        throw notOffered("blinkenlight:" + index);
    }

    public PlayerDevice requestInterfaceCamera(int index, int access) {
        throw notOffered("camera:" + index);
    }

    public PlayerDevice requestInterfaceMap(int index, int access) {
        throw notOffered("map:" + index);
    }

    public PlayerDevice requestInterfacePlanner(int index, int access) {
        throw notOffered("planner:" + index);
    }

    public PlayerDevice requestInterfaceLog(int index, int access) {
        throw notOffered("log:" + index);
    }

    public PlayerDevice requestInterfaceJoystick(int index, int access) {
        throw notOffered("joystick:" + index);
    }

    public PlayerDevice requestInterfaceSpeechRecognition(int index, int access) {
        throw notOffered("speech_recognition:" + index);
    }

    public PlayerDevice requestInterfaceOpaque(int index, int access) {
        throw notOffered("opaque:" + index);
    }

    public PlayerDevice requestInterfacePosition1D(int index, int access) {
        throw notOffered("position1d:" + index);
    }

    public PlayerDevice requestInterfaceActarray(int index, int access) {
        throw notOffered("actarray:" + index);
    }

    public PlayerDevice requestInterfaceLimb(int index, int access) {
        throw notOffered("limb:" + index);
    }

    public PlayerDevice requestInterfaceGraphics2D(int index, int access) {
        throw notOffered("graphics2d:" + index);
    }

    public PlayerDevice requestInterfaceGraphics3D(int index, int access) {
        throw notOffered("graphics3d:" + index);
    }

    public PlayerDevice requestInterfaceRFID(int index, int access) {
        throw notOffered("rfid:" + index);
    }

    public PlayerDevice requestInterfaceWSN(int index, int access) {
        throw notOffered("wsn:" + index);
    }

    public PlayerDevice requestInterfaceHealth(int index, int access) {
        throw notOffered("health:" + index);
    }

    public PlayerDevice requestInterfaceIMU(int index, int access) {
        throw notOffered("imu:" + index);
    }

    public PlayerDevice requestInterfacePointCloud3D(int index, int access) {
        throw notOffered("pointcloud3d:" + index);
    }

    public PlayerDevice requestInterfaceAudio(int index, int access) {
        throw notOffered("audio:" + index);
    }

    public PlayerDevice requestInterfaceStereo(int index, int access) {
        throw notOffered("stereo:" + index);
    }
}
