/// Does one request at a time, and then the latest of those that came meanwhile. `rests` answers whether no other one waits. An error of the work is
/// reported as one that nobody caught, and ends no later request.
export function latestOnly<Request>(work: (request: Request, rests: () => boolean) => Promise<void>): (request: Request) => void {
  let waiting: Request[] = [], isBusy = false;
  return async (request) => {
    waiting = [request];
    if (isBusy) return;
    isBusy = true;
    for (let next = waiting.pop(); next !== undefined; next = waiting.pop()) await work(next, () => waiting.length === 0).catch(reportError);
    isBusy = false;
  };
}
