package io.troupe.player;

import io.troupe.player.structures.camera.PlayerCameraData;
import io.troupe.player.wire.DeviceData;
import org.jspecify.annotations.Nullable;

/**
 * A camera.
 *
 * {@snippet :
 * CameraInterface camera = robot.requestInterfaceCamera(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!camera.isDataReady())
 *     ;
 * PlayerCameraData picture = camera.getData();
 * byte[] pixels = picture.getImage(); // a byte each for red, green and blue
 * int middle = 3 * (picture.getWidth() * (picture.getHeight() / 2) + picture.getWidth() / 2);
 * boolean red = pixels[middle] == -1 && pixels[middle + 1] == 0;
 * }
 *
 * <p><b>Units and shapes.</b> Pixels, row after row from the top, each row from left to right. Simulated cameras send
 * images of the format 5 (24 bits, red first) without compression. Every message has a separate copy of its array.
 *
 * <p><b>Source.</b> Player interface camera.
 */
public class CameraInterface extends PlayerDevice {
    private final LatestValue<PlayerCameraData> data = new LatestValue<>();

    public CameraInterface(PlayerClient client) {
        super(client);
    }

    /** The newest image, or null before the first message. */
    public @Nullable PlayerCameraData getData() {
        return data.get();
    }

    /** True once for each new image. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** Does nothing: images arrive with each frame of data. It exists for programs written for the original client. */
    public void getImage() {}

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.CameraImage image) {
            var newest = new PlayerCameraData();
            newest.setWidth(image.width());
            newest.setHeight(image.height());
            newest.setBpp(image.bitsPerPixel());
            newest.setFormat(image.format());
            newest.setFdiv(image.divisor());
            newest.setCompression(image.compression());
            newest.setImage(image.pixels().toArray());
            newest.setImage_count(image.pixels().size());
            data.put(newest);
        }
    }
}
