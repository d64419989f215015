package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;

/**
 * The {@code requestInterface} methods of the interfaces that this client does not support. A program that calls one
 * gets an error at run time that lists the alternatives.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which names the requested device, the supported
 * interfaces and the devices of the server.
 */
abstract class UnsupportedInterfaces extends Thread implements PlayerConstants {
    UnsupportedInterfaces(String threadName) {
        super(threadName);
    }

    abstract PlayerException notSupported(String device);

    public PowerInterface requestInterfacePower(int index, int access) {
        throw notSupported("power:" + index);
    }

    public PtzInterface requestInterfacePtz(int index, int access) {
        throw notSupported("ptz:" + index);
    }

    public SpeechInterface requestInterfaceSpeech(int index, int access) {
        throw notSupported("speech:" + index);
    }

    public GPSInterface requestInterfaceGPS(int index, int access) {
        throw notSupported("gps:" + index);
    }

    public DIOInterface requestInterfaceDIO(int index, int access) {
        throw notSupported("dio:" + index);
    }

    public AIOInterface requestInterfaceAIO(int index, int access) {
        throw notSupported("aio:" + index);
    }

    public IRInterface requestInterfaceIR(int index, int access) {
        throw notSupported("ir:" + index);
    }

    public WiFiInterface requestInterfaceWiFi(int index, int access) {
        throw notSupported("wifi:" + index);
    }

    public WaveformInterface requestInterfaceWaveform(int index, int access) {
        throw notSupported("waveform:" + index);
    }

    public LocalizeInterface requestInterfaceLocalize(int index, int access) {
        throw notSupported("localize:" + index);
    }

    public MComInterface requestInterfaceMCom(int index, int access) {
        throw notSupported("mcom:" + index);
    }

    public SoundInterface requestInterfaceSound(int index, int access) {
        throw notSupported("sound:" + index);
    }

    public AudioDSPInterface requestInterfaceAudioDSP(int index, int access) {
        throw notSupported("audiodsp:" + index);
    }

    public AudioMixerInterface requestInterfaceAudioMixer(int index, int access) {
        throw notSupported("audiomixer:" + index);
    }

    public Position3DInterface requestInterfacePosition3D(int index, int access) {
        throw notSupported("position3d:" + index);
    }

    public BlinkenlightInterface requestInterfaceBlinkenlight(int index, int access) {
        throw notSupported("blinkenlight:" + index);
    }

    public MapInterface requestInterfaceMap(int index, int access) {
        throw notSupported("map:" + index);
    }

    public PlannerInterface requestInterfacePlanner(int index, int access) {
        throw notSupported("planner:" + index);
    }

    public LogInterface requestInterfaceLog(int index, int access) {
        throw notSupported("log:" + index);
    }

    public JoystickInterface requestInterfaceJoystick(int index, int access) {
        throw notSupported("joystick:" + index);
    }

    public SpeechRecognitionInterface requestInterfaceSpeechRecognition(int index, int access) {
        throw notSupported("speech_recognition:" + index);
    }

    public OpaqueInterface requestInterfaceOpaque(int index, int access) {
        throw notSupported("opaque:" + index);
    }

    public Position1DInterface requestInterfacePosition1D(int index, int access) {
        throw notSupported("position1d:" + index);
    }

    public ActarrayInterface requestInterfaceActarray(int index, int access) {
        throw notSupported("actarray:" + index);
    }

    public LimbInterface requestInterfaceLimb(int index, int access) {
        throw notSupported("limb:" + index);
    }

    public Graphics2DInterface requestInterfaceGraphics2D(int index, int access) {
        throw notSupported("graphics2d:" + index);
    }

    public Graphics3DInterface requestInterfaceGraphics3D(int index, int access) {
        throw notSupported("graphics3d:" + index);
    }

    public RFIDInterface requestInterfaceRFID(int index, int access) {
        throw notSupported("rfid:" + index);
    }

    public WSNInterface requestInterfaceWSN(int index, int access) {
        throw notSupported("wsn:" + index);
    }

    public HealthInterface requestInterfaceHealth(int index, int access) {
        throw notSupported("health:" + index);
    }

    public IMUInterface requestInterfaceIMU(int index, int access) {
        throw notSupported("imu:" + index);
    }

    public PointCloud3DInterface requestInterfacePointCloud3D(int index, int access) {
        throw notSupported("pointcloud3d:" + index);
    }

    public AudioInterface requestInterfaceAudio(int index, int access) {
        throw notSupported("audio:" + index);
    }

    public StereoInterface requestInterfaceStereo(int index, int access) {
        throw notSupported("stereo:" + index);
    }
}
