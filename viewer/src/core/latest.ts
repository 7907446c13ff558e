/// Does one request at a time; of those that come meanwhile only the latest. `rests` tells whether no other one waits.
export function latestOnly<Request>(work: (request: Request, rests: () => boolean) => Promise<void>): (request: Request) => void {
  let waiting: Request[] = [], isBusy = false;
  return async (request) => {
    waiting = [request];
    if (isBusy) return;
    isBusy = true;
    for (let next = waiting.pop(); next !== undefined; next = waiting.pop()) await work(next, () => waiting.length === 0);
    isBusy = false;
  };
}
