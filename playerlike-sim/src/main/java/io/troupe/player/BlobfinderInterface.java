package io.troupe.player;

import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderColorConfig;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderImagerConfig;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceRequest;
import org.jspecify.annotations.Nullable;

/**
 * A camera that reports colour blobs.
 *
 * {@snippet :
 * BlobfinderInterface camera = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
 * while (!camera.isDataReady())
 *     ;
 * for (PlayerBlobfinderBlob blob : camera.getData().getBlobs()) {
 *     log.add("a blob of " + blob.getArea() + " square pixels");
 * }
 * }
 *
 * <p><b>Units and shapes.</b> Pixels, x to the right and y down; colours {@code 0x00RRGGBB}; ranges in metres.
 *
 * <p><b>Source.</b> Player interface blobfinder.
 */
public class BlobfinderInterface extends PlayerDevice {
    private final LatestValue<PlayerBlobfinderData> data = new LatestValue<>();

    public BlobfinderInterface(PlayerClient client) {
        super(client);
    }

    /** The newest data, or null before the first message. */
    public @Nullable PlayerBlobfinderData getData() {
        return data.get();
    }

    /** True once for each new message. */
    public boolean isDataReady() {
        return pc.hasNewData(data);
    }

    /** Sets the colours that one channel tracks. */
    public void setTrackingColor(PlayerBlobfinderColorConfig config) {
        ask(new DeviceRequest.SetColour(
                config.getChannel(),
                config.getRmin(),
                config.getRmax(),
                config.getGmin(),
                config.getGmax(),
                config.getBmin(),
                config.getBmax()));
    }

    /** Sets the camera's parameters; -1 leaves a value unchanged. */
    public void setImagerParams(PlayerBlobfinderImagerConfig config) {
        ask(new DeviceRequest.SetImager(
                config.getBrightness(), config.getContrast(), config.getColormode(), config.getAutogain()));
    }

    @Override
    LatestValue<?> latest() {
        return data;
    }

    @Override
    void accept(DeviceData message) {
        if (message instanceof DeviceData.Blobs image) {
            var newest = new PlayerBlobfinderData();
            newest.setWidth(image.width());
            newest.setHeight(image.height());
            newest.setBlobs_count(image.blobs().size());
            var blobs = new PlayerBlobfinderBlob[image.blobs().size()];
            for (int index = 0; index < blobs.length; index++) {
                blobs[index] = convert(image.blobs().get(index));
            }
            newest.setBlobs(blobs);
            data.put(newest);
        }
    }

    private static PlayerBlobfinderBlob convert(DeviceData.Blob blob) {
        var converted = new PlayerBlobfinderBlob();
        converted.setId(blob.id());
        converted.setColor(blob.colour());
        converted.setArea(blob.area());
        converted.setX(blob.x());
        converted.setY(blob.y());
        converted.setLeft(blob.left());
        converted.setRight(blob.right());
        converted.setTop(blob.top());
        converted.setBottom(blob.bottom());
        converted.setRange(blob.rangeM());
        return converted;
    }
}
