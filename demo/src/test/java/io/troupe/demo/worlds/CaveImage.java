package io.troupe.demo.worlds;

import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.Random;
import javax.imageio.ImageIO;

/**
 * Draws {@code cave.png}: random rock, smoothed by giving each pixel the majority value of its neighbours, without
 * closed cavities.
 */
final class CaveImage {
    private static final int SIDE = 400;
    private static final int RIM = 6;
    private static final int REACH = 5;
    private static final int ROUNDS = 14;
    private static final long SEED = 11;

    private boolean[][] rock = new boolean[SIDE][SIDE];

    private CaveImage() {}

    static BufferedImage draw() {
        var cave = new CaveImage();
        var random = new Random(SEED);
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                boolean start = StrictMath.hypot(x - SIDE / 2.0, y - SIDE / 2.0) < 40;
                cave.rock[y][x] = !start && random.nextInt(1000) < 482;
            }
        }
        for (int round = 0; round < ROUNDS; round++) {
            cave.rock = cave.rounded();
        }
        return cave.image(cave.reachable());
    }

    private boolean isRock(int x, int y) {
        return x < RIM || y < RIM || x >= SIDE - RIM || y >= SIDE - RIM || rock[y][x];
    }

    private boolean[][] rounded() {
        var next = new boolean[SIDE][SIDE];
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                int around = 0;
                for (int dy = -REACH; dy <= REACH; dy++) {
                    for (int dx = -REACH; dx <= REACH; dx++) {
                        around += isRock(x + dx, y + dy) ? 1 : 0;
                    }
                }
                next[y][x] = 2 * around > (2 * REACH + 1) * (2 * REACH + 1);
            }
        }
        return next;
    }

    private boolean[][] reachable() {
        var reached = new boolean[SIDE][SIDE];
        var front = new ArrayDeque<int[]>();
        front.add(new int[] {SIDE / 2, SIDE / 2});
        while (!front.isEmpty()) {
            int[] at = front.remove();
            if (!isRock(at[0], at[1]) && !reached[at[1]][at[0]]) {
                reached[at[1]][at[0]] = true;
                front.add(new int[] {at[0] + 1, at[1]});
                front.add(new int[] {at[0] - 1, at[1]});
                front.add(new int[] {at[0], at[1] + 1});
                front.add(new int[] {at[0], at[1] - 1});
            }
        }
        return reached;
    }

    private BufferedImage image(boolean[][] free) {
        var image = new BufferedImage(SIDE, SIDE, BufferedImage.TYPE_BYTE_BINARY);
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                image.setRGB(x, y, free[y][x] ? 0xffffffff : 0xff000000);
            }
        }
        return image;
    }

    /** Writes the file; run from the root of the repository. */
    public static void main(String[] arguments) throws IOException {
        if (!ImageIO.write(draw(), "png", Path.of("demo", "worlds", "cave.png").toFile())) {
            throw new IOException("no writer for PNG");
        }
    }
}
