package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;

/**
 * The {@code requestInterface} methods of the interfaces that this client does not support. A program that calls one
 * gets an error at run time that lists the alternatives.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which names the requested device, the supported
 * interfaces and the devices of the server.
 */
abstract class UnofferedInterfaces extends Thread implements PlayerConstants {
    UnofferedInterfaces(String threadName) {
        super(threadName);
    }

    abstract PlayerException notOffered(String device);

    public PowerInterface requestInterfacePower(int index, int access) {
        throw notOffered("power:" + index);
    }

    public GripperInterface requestInterfaceGripper(int index, int access) {
        throw notOffered("gripper:" + index);
    }

    public PtzInterface requestInterfacePtz(int index, int access) {
        throw notOffered("ptz:" + index);
    }

    public FiducialInterface requestInterfaceFiducial(int index, int access) {
        throw notOffered("fiducial:" + index);
    }

    public SpeechInterface requestInterfaceSpeech(int index, int access) {
        throw notOffered("speech:" + index);
    }

    public GPSInterface requestInterfaceGPS(int index, int access) {
        throw notOffered("gps:" + index);
    }

    public BumperInterface requestInterfaceBumper(int index, int access) {
        throw notOffered("bumper:" + index);
    }

    public DIOInterface requestInterfaceDIO(int index, int access) {
        throw notOffered("dio:" + index);
    }

    public AIOInterface requestInterfaceAIO(int index, int access) {
        throw notOffered("aio:" + index);
    }

    public IRInterface requestInterfaceIR(int index, int access) {
        throw notOffered("ir:" + index);
    }

    public WiFiInterface requestInterfaceWiFi(int index, int access) {
        throw notOffered("wifi:" + index);
    }

    public WaveformInterface requestInterfaceWaveform(int index, int access) {
        throw notOffered("waveform:" + index);
    }

    public LocalizeInterface requestInterfaceLocalize(int index, int access) {
        throw notOffered("localize:" + index);
    }

    public MComInterface requestInterfaceMCom(int index, int access) {
        throw notOffered("mcom:" + index);
    }

    public SoundInterface requestInterfaceSound(int index, int access) {
        throw notOffered("sound:" + index);
    }

    public AudioDSPInterface requestInterfaceAudioDSP(int index, int access) {
        throw notOffered("audiodsp:" + index);
    }

    public AudioMixerInterface requestInterfaceAudioMixer(int index, int access) {
        throw notOffered("audiomixer:" + index);
    }

    public Position3DInterface requestInterfacePosition3D(int index, int access) {
        throw notOffered("position3d:" + index);
    }

    public BlinkenlightInterface requestInterfaceBlinkenlight(int index, int access) {
        throw notOffered("blinkenlight:" + index);
    }

    public CameraInterface requestInterfaceCamera(int index, int access) {
        throw notOffered("camera:" + index);
    }

    public MapInterface requestInterfaceMap(int index, int access) {
        throw notOffered("map:" + index);
    }

    public PlannerInterface requestInterfacePlanner(int index, int access) {
        throw notOffered("planner:" + index);
    }

    public LogInterface requestInterfaceLog(int index, int access) {
        throw notOffered("log:" + index);
    }

    public JoystickInterface requestInterfaceJoystick(int index, int access) {
        throw notOffered("joystick:" + index);
    }

    public SpeechRecognitionInterface requestInterfaceSpeechRecognition(int index, int access) {
        throw notOffered("speech_recognition:" + index);
    }

    public OpaqueInterface requestInterfaceOpaque(int index, int access) {
        throw notOffered("opaque:" + index);
    }

    public Position1DInterface requestInterfacePosition1D(int index, int access) {
        throw notOffered("position1d:" + index);
    }

    public ActarrayInterface requestInterfaceActarray(int index, int access) {
        throw notOffered("actarray:" + index);
    }

    public LimbInterface requestInterfaceLimb(int index, int access) {
        throw notOffered("limb:" + index);
    }

    public Graphics2DInterface requestInterfaceGraphics2D(int index, int access) {
        throw notOffered("graphics2d:" + index);
    }

    public Graphics3DInterface requestInterfaceGraphics3D(int index, int access) {
        throw notOffered("graphics3d:" + index);
    }

    public RFIDInterface requestInterfaceRFID(int index, int access) {
        throw notOffered("rfid:" + index);
    }

    public WSNInterface requestInterfaceWSN(int index, int access) {
        throw notOffered("wsn:" + index);
    }

    public HealthInterface requestInterfaceHealth(int index, int access) {
        throw notOffered("health:" + index);
    }

    public IMUInterface requestInterfaceIMU(int index, int access) {
        throw notOffered("imu:" + index);
    }

    public PointCloud3DInterface requestInterfacePointCloud3D(int index, int access) {
        throw notOffered("pointcloud3d:" + index);
    }

    public AudioInterface requestInterfaceAudio(int index, int access) {
        throw notOffered("audio:" + index);
    }

    public StereoInterface requestInterfaceStereo(int index, int access) {
        throw notOffered("stereo:" + index);
    }
}
