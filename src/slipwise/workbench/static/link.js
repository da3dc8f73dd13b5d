// The socket: comes back by itself, unpacks arrays, and sends of a number that is dragged only the newest value.

const FIRST_WAIT = 300, LONGEST_WAIT = 4000;

/** Turn a binary message into its head and arrays: name -> Float32Array, or a list of them for several columns. */
export function unpack(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const arrays = {};
  for (const [name, [first, shape]] of Object.entries(head.arrays)) {
    const begin = 4 + length + 4 * first;
    const column = (c) => new Float32Array(buffer, begin + 4 * c * shape[0], shape[0]);
    arrays[name] = shape.length === 1 ? column(0) : Array.from({ length: shape[1] }, (_, c) => column(c));
  }
  return { ...head, arrays };
}

export class Link {
  /** @param listen called with every message; @param opened called with true and false as the socket comes and goes */
  constructor(listen, opened) {
    this.listen = listen;
    this.opened = opened;
    this.wait = FIRST_WAIT;
    this.asked = 0;
    this.#begin();
  }

  #begin() {
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    this.newest = null;
    this.waiting = 0;
    this.released = false;
    this.socket = new WebSocket(address);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => { this.wait = FIRST_WAIT; this.opened(true); };
    this.socket.onmessage = ({ data }) => this.#hear(typeof data === "string" ? JSON.parse(data) : unpack(data));
    this.socket.onclose = () => {
      if (this.over) return;
      this.opened(false);
      setTimeout(() => this.#begin(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
    };
  }

  /** Come back no more. */
  stop() { this.over = true; }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /** Tell the newest value of a number; older ones that were not sent yet are forgotten. */
  drag(key, value) {
    this.newest = { key, value };
    this.#flush();
  }

  /** The number was let go: everybody may see what it has changed. */
  release() {
    this.released = true;
    this.#flush();
  }

  #flush() {
    if (this.waiting) return;
    if (this.newest) {
      this.waiting = ++this.asked;
      this.sent = performance.now();
      this.send({ do: "drag", ...this.newest, n: this.waiting });
      this.newest = null;
    } else if (this.released) {
      this.released = false;
      this.send({ do: "settle" });
    }
  }

  #hear(message) {
    this.listen(message);
    if (message.answers && message.answers === this.waiting) {
      performance.measure("drag", { start: this.sent, end: performance.now() });
      this.waiting = 0;
      this.#flush();
    }
  }
}
