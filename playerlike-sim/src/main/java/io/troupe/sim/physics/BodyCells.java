package io.troupe.sim.physics;

import java.util.Arrays;
import org.jbox2d.callbacks.DebugDraw;
import org.jbox2d.callbacks.TreeCallback;
import org.jbox2d.callbacks.TreeRayCastCallback;
import org.jbox2d.collision.AABB;
import org.jbox2d.collision.RayCastInput;
import org.jbox2d.collision.broadphase.BroadPhaseStrategy;
import org.jbox2d.common.Settings;
import org.jbox2d.common.Vec2;
import org.jspecify.annotations.Nullable;

/**
 * Finds the boxes of bodies that overlap, by the cells of one metre that they reach into.
 *
 * <p><b>Role.</b> Takes the place of jbox2d's tree. Each box is stored with a margin (the fat box), computed in the
 * same way, so that small moves need no update. jbox2d sorts the pairs that it finds by the numbers of the boxes, which
 * count up in order of creation as the tree's do. So the contacts are the same, in the same order.
 *
 * <p><b>Cost.</b> A box of up to {@link #MOST_CELLS} cells is in the list of each cell; larger ones are compared with
 * every query. The cells repeat every some metres, more of them the more boxes there are. A query reports a box once,
 * or several times if it is longer than these metres.
 */
final class BodyCells implements BroadPhaseStrategy {
    private static final int LEAST_SIDE = 16; // a power of two, as all sides
    private static final int CELLS_PER_BOX = 4;
    private static final int MOST_CELLS = 128;
    private static final int NONE = -1;
    private static final int FIELDS = 4;

    private AABB[] boxes = new AABB[64]; // jbox2d reads them
    private @Nullable Object[] data = new Object[64];
    private float[] bounds = new float[FIELDS * 64]; // of the same boxes: least x and y, greatest x and y
    private int[] ranges = new int[FIELDS * 64]; // first column and row, last column and row; large boxes: last < first
    private int count;
    private int[] free = new int[0]; // numbers of destroyed boxes, to be used again from the last
    private int freeCount;
    private int newest = NONE;
    private int side = LEAST_SIDE; // of the square of cells
    private int[] firstNodes = new int[side * side];
    private int[] nextNodes = new int[64];
    private int[] proxies = new int[64]; // by node
    private int nodeCount;
    private int freeNode = NONE;
    private int[] large = new int[16];
    private int largeCount;
    private long moveCount;
    private long reinsertCount;

    BodyCells() {
        Arrays.fill(firstNodes, NONE);
    }

    @Override
    public int createProxy(AABB box, @Nullable Object userData) {
        if (freeCount > 0) {
            newest = free[--freeCount];
            data[newest] = userData;
            fatten(newest, box, 0, 0);
            insert(newest);
            return newest;
        }
        if (count == boxes.length) {
            boxes = Arrays.copyOf(boxes, 2 * count);
            data = Arrays.copyOf(data, 2 * count);
            bounds = Arrays.copyOf(bounds, 2 * FIELDS * count);
            ranges = Arrays.copyOf(ranges, 2 * FIELDS * count);
        }
        boxes[count] = new AABB();
        data[count] = userData;
        fatten(count, box, 0, 0);
        insert(count);
        newest = count++;
        if (CELLS_PER_BOX * count > side * side) {
            grow();
        }
        return newest;
    }

    private void grow() {
        side *= 2;
        firstNodes = new int[side * side];
        Arrays.fill(firstNodes, NONE);
        nodeCount = 0;
        freeNode = NONE;
        largeCount = 0;
        for (int proxy = 0; proxy < count; proxy++) {
            if (data[proxy] != null) {
                insert(proxy);
            }
        }
    }

    @Override
    public void destroyProxy(int proxy) {
        remove(proxy);
        setRange(proxy, 1, 0, 0, 0);
        data[proxy] = null;
        if (freeCount == free.length) {
            free = Arrays.copyOf(free, Math.max(16, 2 * freeCount));
        }
        free[freeCount++] = proxy;
    }

    @Override
    public boolean moveProxy(int proxy, AABB box, Vec2 displacement) {
        moveCount++;
        if (holds(boxes[proxy], box)) {
            return false;
        }
        reinsertCount++;
        fatten(proxy, box, displacement.x * Settings.aabbMultiplier, displacement.y * Settings.aabbMultiplier);
        int at = FIELDS * proxy;
        boolean small = ranges[at] <= ranges[at + 2];
        if (!small
                || ranges[at] != cell(bounds[at])
                || ranges[at + 1] != cell(bounds[at + 1])
                || ranges[at + 2] != cell(bounds[at + 2])
                || ranges[at + 3] != cell(bounds[at + 3])) {
            remove(proxy);
            insert(proxy);
        }
        return true;
    }

    /** True if the outer box contains the inner one. {@code AABB.contains} has the test reversed. */
    static boolean holds(AABB outer, AABB inner) {
        return outer.lowerBound.x <= inner.lowerBound.x
                && outer.lowerBound.y <= inner.lowerBound.y
                && outer.upperBound.x >= inner.upperBound.x
                && outer.upperBound.y >= inner.upperBound.y;
    }

    /** Sets the fat box: the margin of jbox2d on all sides, and the predicted move in its direction. */
    private void fatten(int proxy, AABB box, float moveX, float moveY) {
        float minX = box.lowerBound.x - Settings.aabbExtension;
        float minY = box.lowerBound.y - Settings.aabbExtension;
        float maxX = box.upperBound.x + Settings.aabbExtension;
        float maxY = box.upperBound.y + Settings.aabbExtension;
        if (moveX < 0) {
            minX += moveX;
        } else {
            maxX += moveX;
        }
        if (moveY < 0) {
            minY += moveY;
        } else {
            maxY += moveY;
        }
        boxes[proxy].lowerBound.set(minX, minY);
        boxes[proxy].upperBound.set(maxX, maxY);
        int at = FIELDS * proxy;
        bounds[at] = minX;
        bounds[at + 1] = minY;
        bounds[at + 2] = maxX;
        bounds[at + 3] = maxY;
    }

    private static int cell(float coordinate) {
        return (int) Math.floor(coordinate);
    }

    private int index(int column, int row) {
        return (row & side - 1) * side + (column & side - 1);
    }

    /** True for a box in the lists of the cells, and for a query that looks into them. */
    private static boolean isSmall(int firstColumn, int firstRow, int lastColumn, int lastRow) {
        long columns = lastColumn - firstColumn + 1L;
        long rows = lastRow - firstRow + 1L;
        return columns * rows <= MOST_CELLS;
    }

    private void setRange(int proxy, int firstColumn, int firstRow, int lastColumn, int lastRow) {
        int at = FIELDS * proxy;
        ranges[at] = firstColumn;
        ranges[at + 1] = firstRow;
        ranges[at + 2] = lastColumn;
        ranges[at + 3] = lastRow;
    }

    private void insert(int proxy) {
        int at = FIELDS * proxy;
        int firstColumn = cell(bounds[at]);
        int firstRow = cell(bounds[at + 1]);
        int lastColumn = cell(bounds[at + 2]);
        int lastRow = cell(bounds[at + 3]);
        if (!isSmall(firstColumn, firstRow, lastColumn, lastRow)) {
            setRange(proxy, 1, 0, 0, 0);
            if (largeCount == large.length) {
                large = Arrays.copyOf(large, 2 * largeCount);
            }
            large[largeCount++] = proxy;
            return;
        }
        setRange(proxy, firstColumn, firstRow, lastColumn, lastRow);
        for (int row = firstRow; row <= lastRow; row++) {
            for (int column = firstColumn; column <= lastColumn; column++) {
                int cell = index(column, row);
                int node = takeNode();
                proxies[node] = proxy;
                nextNodes[node] = firstNodes[cell];
                firstNodes[cell] = node;
            }
        }
    }

    private int takeNode() {
        if (freeNode != NONE) {
            int node = freeNode;
            freeNode = nextNodes[node];
            return node;
        }
        if (nodeCount == proxies.length) {
            proxies = Arrays.copyOf(proxies, 2 * nodeCount);
            nextNodes = Arrays.copyOf(nextNodes, 2 * nodeCount);
        }
        return nodeCount++;
    }

    private void remove(int proxy) {
        int at = FIELDS * proxy;
        if (ranges[at] > ranges[at + 2]) {
            removeLarge(proxy);
            return;
        }
        for (int row = ranges[at + 1]; row <= ranges[at + 3]; row++) {
            for (int column = ranges[at]; column <= ranges[at + 2]; column++) {
                int cell = index(column, row);
                int before = NONE;
                int node = firstNodes[cell];
                while (proxies[node] != proxy) {
                    before = node;
                    node = nextNodes[node];
                }
                if (before == NONE) {
                    firstNodes[cell] = nextNodes[node];
                } else {
                    nextNodes[before] = nextNodes[node];
                }
                nextNodes[node] = freeNode;
                freeNode = node;
            }
        }
    }

    private void removeLarge(int proxy) {
        for (int i = 0; i < largeCount; i++) {
            if (large[i] == proxy) {
                large[i] = large[--largeCount];
                return;
            }
        }
    }

    @Override
    public void query(TreeCallback callback, AABB box) {
        float minX = box.lowerBound.x;
        float minY = box.lowerBound.y;
        float maxX = box.upperBound.x;
        float maxY = box.upperBound.y;
        int firstColumn = cell(minX);
        int firstRow = cell(minY);
        int lastColumn = cell(maxX);
        int lastRow = cell(maxY);
        if (!isSmall(firstColumn, firstRow, lastColumn, lastRow)) {
            for (int proxy = 0; proxy < count; proxy++) {
                if (data[proxy] != null && overlaps(proxy, minX, minY, maxX, maxY)) {
                    callback.treeCallback(proxy);
                }
            }
            return;
        }
        for (int i = 0; i < largeCount; i++) {
            if (overlaps(large[i], minX, minY, maxX, maxY)) {
                callback.treeCallback(large[i]);
            }
        }
        for (int row = firstRow; row <= lastRow; row++) {
            for (int column = firstColumn; column <= lastColumn; column++) {
                for (int node = firstNodes[index(column, row)]; node != NONE; node = nextNodes[node]) {
                    int proxy = proxies[node];
                    int at = FIELDS * proxy;
                    boolean first = column == Math.max(firstColumn, ranges[at])
                            && row == Math.max(firstRow, ranges[at + 1]); // of the cells that both reach into
                    if (first && overlaps(proxy, minX, minY, maxX, maxY)) {
                        callback.treeCallback(proxy);
                    }
                }
            }
        }
    }

    private boolean overlaps(int proxy, float minX, float minY, float maxX, float maxY) {
        int at = FIELDS * proxy;
        return bounds[at] <= maxX && bounds[at + 1] <= maxY && bounds[at + 2] >= minX && bounds[at + 3] >= minY;
    }

    /** True if the fat boxes of two proxies overlap, by the test of jbox2d. */
    boolean overlap(int one, int other) {
        int at = FIELDS * one;
        return overlaps(other, bounds[at], bounds[at + 1], bounds[at + 2], bounds[at + 3]);
    }

    float minX(int proxy) {
        return bounds[FIELDS * proxy];
    }

    float minY(int proxy) {
        return bounds[FIELDS * proxy + 1];
    }

    float maxX(int proxy) {
        return bounds[FIELDS * proxy + 2];
    }

    float maxY(int proxy) {
        return bounds[FIELDS * proxy + 3];
    }

    @Override
    public AABB getFatAABB(int proxy) {
        return boxes[proxy];
    }

    @Override
    public @Nullable Object getUserData(int proxy) {
        return data[proxy];
    }

    /** The proxy created last. */
    int newestProxy() {
        return newest;
    }

    /** Number of calls of moveProxy. */
    long moveCount() {
        return moveCount;
    }

    /** Number of moves that changed a fat box. */
    long reinsertCount() {
        return reinsertCount;
    }

    // ---- what this package does not use

    @Override
    public void raycast(TreeRayCastCallback callback, RayCastInput input) {
        throw new UnsupportedOperationException("rays are cast by io.troupe.sim.device.Scene");
    }

    @Override
    public void drawTree(DebugDraw draw) {
        throw new UnsupportedOperationException("there is no tree to draw");
    }

    @Override
    public int computeHeight() {
        return 0;
    }

    @Override
    public int getHeight() {
        return 0;
    }

    @Override
    public int getMaxBalance() {
        return 0;
    }

    @Override
    public float getAreaRatio() {
        return 0;
    }

    @Override
    public int getInsertionCount() {
        return 0;
    }
}
