#!/usr/bin/python3
import json, math, os, subprocess, sys
def wilson(k,n):
    if n==0: return (0,0)
    z=1.96; p=k/n; d=1+z*z/n; c=(p+z*z/2/n)/d; h=z*math.sqrt(p*(1-p)/n+z*z/4/n/n)/d; return (c-h,c+h)
GEO=('axis_tilt','base_frame','tool_offset')
def same(t,f):
    n,j=t; e,fj=f
    if n==e and (j is None or j==fj): return True
    if n in('gear_harmonic',) and e in('transmission_error',) and j==fj: return True
    if n=='gravity_balancer' and e in('gear_harmonic','transmission_error') and fj==j: return True
    if n=='joint_gain' and e=='transmission_error' and fj==j: return True
    return False
def run(prog, folder, tag):
    out=f'{folder}/{tag}'
    if not os.path.exists(out+'/result.json'):
        subprocess.run(['rm','-rf',out]); p=subprocess.run(['timeout','400',prog,'--problem',folder+'/problem.yaml','--out',out,'--quiet'],capture_output=True,text=True)
        if not os.path.exists(out+'/result.json'): return None,(p.stderr+p.stdout)[-200:]
    return json.load(open(out+'/result.json')),''
def score(t,r):
    d=r.get('diagnosis')
    if not d: return dict(state='nodiag')
    F=[(f['effect'],f.get('joint')) for f in d['findings']]
    H=[[(e['effect'],e.get('joint')) for e in h['effects']] for h in d.get('hypotheses',[]) if h['kept']]
    C=[(c['effect'],c.get('joint')) for f in d['findings'] for c in f.get('confusable_with',[])]
    truth=[tuple(x) for x in t['truth'] if x[0]!='unnamed']; unn=[x for x in t['truth'] if x[0]=='unnamed']
    named=[f for f in F if f[0] not in GEO]; geo=[f for f in F if f[0] in GEO]
    hit=all(any(same(x,f) for f in F) for x in truth); 
    listed=all(any(same(x,f) for f in F+C) or any(any(same(x,f) for f in h) for h in H) for x in truth)
    extra=[f for f in named if not any(same(x,f) for x in truth)]
    wrong = bool(extra) and not listed
    gx=[g for g in geo if not (t['geo'] and {'base':'base_frame','tool':'tool_offset','tilt':'axis_tilt'}[t['geo'][0]]==g[0])]
    return dict(state='ok',verdict=d['verdict'],F=F,hit=hit,listed=listed,extra=extra,wrong=wrong,geo_extra=gx,alarm=d['verdict']!='consistent',nlist=len(H),sec=d.get('seconds'),rest=d.get('unexplained',{}).get('slot'))
if __name__=='__main__':
    prog,tag,root=sys.argv[1:4]; verbose=len(sys.argv)>4
    cs=sorted(os.listdir(root),key=lambda s:int(s[1:])); S=[]
    for c in cs:
        f=f'{root}/{c}'
        if not os.path.exists(f+'/truth.json'): continue
        t=json.load(open(f+'/truth.json')); r,err=run(prog,f,tag)
        s=score(t,r) if r else dict(state='fail '+err)
        S.append((c,t,s))
        if verbose: print(c,t['kind'],t['robot'],t['meas'],t['est'],f"st={t['strength']:.1f} shows={t['shows']:.0f} N={t['N']} dec={t['dec']} rep={t['reps']} out={t['outl']} m={t['mass']} sig={'y' if t['given'] else 'n'}",t['truth'],t['geo'],'->',s.get('verdict',s['state']),s.get('F'),'HIT' if s.get('hit') else 'listed' if s.get('listed') else 'miss','X' if s.get('extra') else '','WRONG' if s.get('wrong') else '',f"{s.get('sec') or 0:.1f}s",s.get('rest') or '',flush=True)
    ok=[(c,t,s) for c,t,s in S if s['state']=='ok']
    null=[x for x in ok if x[1]['kind']=='null' and not x[1]['geo']]
    det=[x for x in ok if x[1]['truth'] and x[1]['shows']>9 and x[1]['kind']!='product']
    a=sum(x[2]['alarm'] for x in null); h=sum(x[2]['hit'] and not x[2]['extra'] for x in det); l=sum(x[2]['listed'] for x in det); w=sum(x[2]['wrong'] for x in det); e=sum(bool(x[2]['extra']) and not x[2]['wrong'] for x in det)
    g=sum(bool(x[2]['geo_extra']) for x in ok)
    print(tag,'cases',len(S),'failed',len(S)-len(ok)); P=lambda k,n:f'{k}/{n} ({100*wilson(k,n)[0]:.0f}-{100*wilson(k,n)[1]:.0f} %)'
    print('false alarms',P(a,len(null)),' right alone',P(h,len(det)),' right or listed',P(l,len(det)),' wrong',P(w,len(det)),' extra',P(e,len(det)),' geometry extra',P(g,len(ok)))
    pr=[x for x in ok if x[1]['kind']=='product' and x[1]['shows']>9]; print('unnamed physics: not explained by names alone', sum(x[2]['verdict'] in('unexplained','partly_explained','ambiguous') for x in pr),'of',len(pr))
    for key in('est','meas'):
        for v in sorted({x[1][key] for x in det}): D=[x for x in det if x[1][key]==v]; print('  ',key,v,'listed',sum(x[2]['listed'] for x in D),'of',len(D))
    for lo,hi in((0,1),(1,3),(3,10),(10,1e9)):
        D=[x for x in det if lo<=x[1]['rms']/x[1]['sig']<hi]; print('   rms/sigma',lo,hi,'listed',sum(x[2]['listed'] for x in D),'of',len(D))
    secs=sorted(x[2]['sec'] for x in ok if x[2]['sec']); print('   median s',secs[len(secs)//2] if secs else None,'max',secs[-1] if secs else None)
